"""Show the live page of an estimator that follows a session, until Ctrl-C."""

from __future__ import annotations

import argparse
import signal
import sys

from live_rig import live_rig


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--port', type=int, default=8780, help='of the page; default: %(default)s')
    parser.add_argument('--arm', action='store_true', help='of an arm, in place of a unit')
    options = parser.parse_args()
    # Once begun, what ends this is to end the others too.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with live_rig(port=options.port, is_arm=options.arm) as rig:
        print(f'\nLive page: {rig.url}\nCtrl-C ends it.', flush=True)
        try:
            code = rig.view.process.wait()
        except KeyboardInterrupt:
            return
        raise RuntimeError(f'view ended with exit code {code}:\n{rig.view.output()}')


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        pass
    except (TimeoutError, RuntimeError) as error:
        sys.exit(f'demo failed: {error}')
