"""`yade -n -x own.py CLASS KIND NAME...`, see main() in yade_scripts.py."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade_scripts

yade_scripts.main(globals())
