"""python3 -m talus.figures ARGUMENTS: the command `talus figures` without the program."""

import sys

from talus.start import run

sys.exit(run("figures", sys.argv[1:]))
