"""`python3 -m yadefrag`, should the package be there already: see about_run.py."""

import sys

from yadefrag import about_run

sys.exit(about_run.main())
