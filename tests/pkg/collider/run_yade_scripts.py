"""`yade -n -x run_yade_scripts.py CLASS KIND NAME...`, see main() in yade_scripts.py."""
import os
import sys

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]
import yade_scripts

yade_scripts.main(globals())
