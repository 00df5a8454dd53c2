"""The project's folder, and the yade that runs the tests."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / 'examples'


def yadeCommand():
    """The yade that runs these tests; its PYTHONPATH is inherited."""
    return [getattr(sys, 'yade_argv', ['/usr/bin/yade'])[0], '-n', '-x']
