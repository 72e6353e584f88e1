"""The command ``stribeck`` as ``python -m stribeck``."""

import signal
import sys

from . import _stribeck


def main() -> int:
    """Run the command with the arguments of the process; its exit status."""
    # Ctrl-C is the command's: a run ends with a checkpoint.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _stribeck.run_command(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
