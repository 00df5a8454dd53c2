"""Chains of headers that prove that each compiles alone: python3 scripts/header_chains.py FOLDER HEADER...

Prints the headers (relative to FOLDER) of one chain a line, by `;`. Each header of a chain includes the one
before it. So in a unit that includes a chain in this order, the text of a header sees only what it includes
itself: a missing include is found as in a unit of its own. The fewest chains cover all headers (a largest
matching), since the units spend their time on the same headers of YADE, Boost and the standard library.
"""
import os
import re
import sys

INCLUDE = re.compile(r'^#include "(.*)"', re.M)


def includedBy(folder, headers):
    """All headers of the folder that each includes before its code, directly or not."""
    direct, found = {}, {}
    for header in headers:
        with open(os.path.join(folder, header)) as file:
            top = re.split('^namespace', file.read(), flags=re.M)[0]
        direct[header] = set(INCLUDE.findall(top)) & set(headers)
    for header in headers:
        found[header], open_ = set(), [header]
        while open_:
            new = direct[open_.pop()] - found[header]
            found[header] |= new
            open_ += new
    return found


def chainsOf(included):
    """Lists of headers; each contains the one before it."""
    before = {}  # the header before each in its chain

    def place(header, tried):
        for later in included:
            if header in included[later] and later not in tried:
                tried.add(later)
                if later not in before or place(before[later], tried):
                    before[later] = header
                    return True
        return False

    lasts = [header for header in included if not place(header, set())]
    chains = []
    for header in lasts:
        chain = [header]
        while chain[0] in before:
            chain.insert(0, before[chain[0]])
        chains.append(chain)
    return chains


if __name__ == '__main__':
    print('\n'.join(';'.join(chain) for chain in chainsOf(includedBy(sys.argv[1], sys.argv[2:]))))
