"""`python3 -m yadefrag`, if the package is already imported: see about_run.py."""

import sys

from yadefrag import about_run

sys.exit(about_run.main())
