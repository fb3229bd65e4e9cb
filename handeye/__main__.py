"""`python -m handeye`."""

import sys

try:
    from handeye.cli import main
except KeyboardInterrupt:  # Ctrl-C before there is anything that could be interrupted
    sys.exit(130)

main()
