"""The program ``tendon-statics``: one verb per file, each with `add_arguments` and `run`."""
