"""Scenes of test_ensemble.py, cheap enough for many runs; each run loads this file."""
import os
import random
import time
import warnings

from tradeoff_scenes import block
from yade import O

DURATION = .02  # s


def flight(choices):
    """A block; its value is drawn from the seed, about the strength."""
    choices.size(1.)
    fe = block(choices)
    return fe, choices['seed'], choices.get('strength', 5.)


def draw(built):
    """As many positive numbers as the seed."""
    _, seed, strength = built
    random.seed(seed)
    return [random.lognormvariate(0, .3) * strength for _ in range(3 + seed % 3)]


def odd(choices):
    """Seed 1 crashes, 2 is refused, 3 takes too long, 4 measures nothing."""
    seed = choices['seed']
    if seed == 1:
        os.abort()
    if seed == 2:
        raise ValueError('no such strength.')
    if seed == 3:
        time.sleep(60)
    block(choices)
    return seed


def oddValue(seed):
    return float('nan') if seed == 4 else seed


def warned(choices):
    """All but seed 2 warn of a number; all of the same thing."""
    seed = choices['seed']
    block(choices)
    if seed != 2:
        warnings.warn('no such size, %d' % seed)
    for _ in range(2):
        warnings.warn('bodies lie')
    warnings.warn('old', DeprecationWarning)
    return seed


def counted(choices):
    """Leaves a line in a file for each run that is really done."""
    block(choices)
    with open(os.environ['YADEFRAG_COUNT'], 'a') as out:
        out.write('%d\n' % choices['seed'])
    return choices['seed']


def same(seed):
    return seed + O.time
