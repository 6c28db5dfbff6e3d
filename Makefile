# `make help` lists the targets. What they need is made once, in .venv/ and install/.
# Variables: PYTHON=/path/to/python3 for the set-up, ROS_DISTRO=kilted, ARGS='...' for pytest.
SHELL := bash
.DEFAULT_GOAL := help

# The Python for .venv; empty: the first that fits.
PYTHON ?=

# jazzy or kilted, which has its .venv/ and install/ in build/kilted/.
export ROS_DISTRO := $(or $(ROS_DISTRO),jazzy)
made := $(if $(filter-out jazzy,$(ROS_DISTRO)),build/$(ROS_DISTRO)/)
run := set -euo pipefail; . tools/env.bash;

sources := package.xml setup.py setup.cfg colcon.pkg colcon_defaults.yaml \
  $(shell find tendon_statics config launch layouts rviz security urdf resource interfaces -type f \
    -not -path '*/__pycache__/*' -not -name '*.swp')

.PHONY: help
help: ## List the targets
	@echo 'Targets (PYTHON=/path/to/python3 chooses the Python of the set-up; ROS_DISTRO=kilted Kilted):'
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /  make \1\t/' | expand -t 28

.PHONY: setup
setup: $(made)install/.complete ## Install ROS 2 into .venv/ (or use apt's) and build into install/

.PHONY: demo
demo: setup ## Drive the estimator node over real ROS 2 and print what it publishes (VIEW=1: and show it live; ARM=1: an arm)
	@$(run) python tools/$(if $(ARM),demo_arm.py,demo.py)$(if $(VIEW), && python tools/demo_view.py $(if $(ARM),--arm))

# Byte code is kept whatever the shell says, else each worker compiles all tests again, and each
# program that a test starts the tools.
.PHONY: test
test: setup ## Run all tests (ARGS='-m node' chooses; with CI=1 more examples of each property)
	@$(run) PYTHONDONTWRITEBYTECODE= pytest $(ARGS)

# How long to soak.
MINUTES ?= 5

.PHONY: soak
soak: setup ## Stream faulty tensions at the estimators and balance the books (MINUTES=5)
	@$(run) cd tools && python -m soak --minutes $(MINUTES) $(ARGS)

# How often to run the tests of the node beside busy loops.
RUNS ?= 10

.PHONY: steady
steady: setup ## Run the tests of the node beside four busy loops, ten times (RUNS=10)
	@$(run) python tools/steady.py --runs $(RUNS)

.PHONY: measure-filter
measure-filter: setup ## Measure the filter on random sessions, beside the tracker (ARGS='--sessions 48')
	@$(run) cd tools && python -m measure_filter $(ARGS)

.PHONY: measure-distribution
measure-distribution: setup ## Measure the distribution of one pair against draws (ARGS='--units 300')
	@$(run) python tools/measure_distribution.py $(ARGS)

.PHONY: measure-smoothing
measure-smoothing: setup ## Measure how the filter smooths tensions, in its own errors
	@$(run) cd tools && python -m measure_filter.smoothing $(ARGS)

.PHONY: measure-rests
measure-rests: setup ## Measure whether the filter leaves a unit at rest where it is (ARGS='--seconds 3600')
	@$(run) cd tools && python -m measure_filter.rests $(ARGS)

.PHONY: measure-consistency
measure-consistency: setup ## Measure how well the filter finds a model that is wrong (ARGS='--sessions 4')
	@$(run) python tools/measure_consistency.py $(ARGS)

.PHONY: measure-arm
measure-arm: setup ## Hold the arm against brute force on random arms (ARGS='--arms 200')
	@$(run) python tools/measure_arm.py $(ARGS)

.PHONY: measure-arm-filter
measure-arm-filter: setup ## Measure the arm's filter on random sessions, beside the tracker (ARGS='--arms 20')
	@$(run) python tools/measure_arm_filter.py $(ARGS)

.PHONY: measure-view
measure-view: setup ## Measure what the live page costs at 500 Hz, in a real browser
	@$(run) python tools/measure_view.py $(ARGS)

.PHONY: picture
picture: setup ## Make again the pictures of the live page in docs/, in a real browser
	@$(run) python tools/make_view_picture.py

.PHONY: bench
bench: setup ## Measure the speed beside NumPy, C and a bare relay; tables, and build/bench.json
	@$(run) cd tools && python -m bench --json ../build/bench.json

.PHONY: validate
validate: setup $(made).venv/.validate ## Hold the contact laws against rigid-body simulation (minutes)
	@$(run) cd tools && python -m validate

.PHONY: lint
lint: $(made).venv/.complete ## Check style and types
	@$(run) ruff check . && ruff format --check . && mypy

.PHONY: docs
docs: setup ## Make again the tables and figures of docs/
	@$(run) python tools/make_docs.py

.PHONY: site
site: setup $(made).venv/.site ## Build the documentation as a site, build/site/index.html
	@$(run) python -m sphinx --fail-on-warning --keep-going --quiet \
	  --fresh-env --write-all -d build/site.doctrees docs build/site
	@echo "== build/site/index.html"

.PHONY: clean
clean: ## Remove all that the targets made
	rm -rf .venv build install log .hypothesis .mypy_cache .pytest_cache .ruff_cache

$(made).venv/.complete: tools/make_venv.bash tools/mend_wheel_cmake.py tools/requirements.txt \
  $(wildcard tools/requirements-$(ROS_DISTRO).txt)
	@tools/make_venv.bash $(PYTHON)
	@touch $@

$(made).venv/.validate: tools/requirements-validate.txt $(made).venv/.complete
	@$(run) pip install --quiet -r $<
	@touch $@

$(made).venv/.site: tools/requirements-site.txt $(made).venv/.complete
	@echo "== what the site needs: Sphinx, from $<"
	@$(run) pip install --quiet -r $<
	@touch $@

$(made)install/.complete: $(made).venv/.complete $(sources)
	@echo "== building tendon_statics_interfaces and tendon_statics into $(@D)/ (half a minute)"
	@# Modules that are gone would stay there, and be imported.
	@rm -rf $(@D)/tendon_statics $(made)build/tendon_statics
	@$(run) python -m colcon --log-base $(made)log build --build-base $(made)build \
	    --install-base $(made)install --event-handlers console_cohesion- console_stderr- \
	    desktop_notification- summary- \
	  || { echo 'tendon_statics: the build failed; $(made)log/latest_build has why' >&2; exit 1; }
	@# Else each start compiles all anew, where the shell forbids to keep byte code.
	@$(run) python -m compileall -q $(@D)/*/lib/python3*/site-packages
	@touch $@
