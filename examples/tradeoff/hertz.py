"""A half cylinder pressed on a block at rest, compared with Hertz's ellipse of pressure.

35 MN/m on a steel cylinder of radius 50 mm, the block of a third of its stiffness; plane strain.
Hertz's half spaces are an approximation: our finest meshes have a p₀ that is 1 % higher.
"""
import math

import numpy as np

RADIUS, LINE = .05, 35e6  # m, N/m
STEEL = dict(young=210e9, poisson=.3, density=7800, frictionAngle=0)
LIGHT = dict(young=70e9, poisson=.3, density=2600, frictionAngle=0)  # with the same wave speed
EVEN = 9e-3  # m, half width of the region with possible contact
FAR, WIDE = .01, .1  # m: edges far from the contact, half the width of the block and its depth
SMOOTH = .6 * RADIUS  # m, around the contact, in which surfaces may be smooth
BOUNCE = 5e3  # 1/s, bouncing frequency of the cylinder on the block


def ellipse(planeStress):
    """(p₀ in Pa, half width in m), in plane stress or strain."""
    compliance = sum((1 - m['poisson']**2 * (not planeStress)) / m['young'] for m in (STEEL, LIGHT))
    width = math.sqrt(4 * LINE * RADIUS * compliance / math.pi)
    return 2 * LINE / (math.pi * width), width


def graded(fine, end):
    """Distances up to `end` (m): `fine` in the region with possible contact, then increasing."""
    at = [0.]
    while at[-1] < end:
        at.append(at[-1] + min(FAR, fine + max(0, .25 * (at[-1] - EVEN))))
    at = np.array(at) * end / at[-1]
    return np.concatenate([-at[:0:-1], at])


def scene(choices):
    """The half cylinder, the block, and a uniform load on the flat top."""
    size = choices.size(1e-3)
    # A critically damped bounce comes to rest within .7 ms.
    fe = choices.solver(passes=2, damping=4 * math.pi * BOUNCE)
    steel, light = choices.material(**STEEL), choices.material(**LIGHT)
    angles = graded(1.5 * size, math.pi / 2 * RADIUS) / RADIUS
    round_ = [(RADIUS * math.sin(a), RADIUS * (1 - math.cos(a))) for a in angles]
    flat = [(x, 0.) for x in graded(size, WIDE)[::-1]]
    wanted = choices.smooth(True)
    for outline, material, held in (
            (round_ + [(0, RADIUS)], steel,
             lambda x, y: 'x' if math.hypot(x, y) < 1e-9 or math.hypot(x, y - RADIUS) < 1e-9
             else False),
            ([(-WIDE, -WIDE), (WIDE, -WIDE)] + flat, light, lambda x, y: y < 1e-9 - WIDE)):
        flags = [wanted and abs(x) < SMOOTH and abs(y) < SMOOTH for x, y in outline]
        fe.addPolygon(outline, size=FAR, material=material, fixed=held, smooth=flags,
                      selfContact=False, mesh=choices.get('mesh', 'regular'),
                      element=choices.get('element', 'linear'))
    load(fe)
    choices.engines(fe)
    return fe, ellipse(steel.planeStress)


def load(fe):
    """Distributes the load to the nodes of the flat top."""
    nodes = fe.nodes
    top = np.flatnonzero(nodes[:, 1] > RADIUS * (1 - 1e-9))
    top = top[np.argsort(nodes[top, 0])]
    share = LINE * np.diff(nodes[top, 0]) / (4 * RADIUS)
    loads = np.zeros_like(nodes)
    loads[top[:-1], 1] -= share
    loads[top[1:], 1] -= share
    fe.loads = loads


def measure(built):
    """rms of the pressure's deviation from Hertz's over the cylinder's surface, relative to that of
    Hertz's."""
    fe, (peak, width) = built
    loop = fe.surfaces[0]  # the cylinder was added first
    x = fe.nodes[loop]
    near = x[:, 1] < RADIUS / 2
    order = np.argsort(x[near, 0])
    at = x[near, 0][order] / width
    force = np.linalg.norm(fe.contactForces[loop], axis=1)[near][order]
    # Hertz's pressure averaged over a node's part of the surface, from middle to middle.
    ends = np.clip((at[1:] + at[:-1]) / 2, -1, 1)
    right = peak * width / 2 * np.diff(ends * np.sqrt(1 - ends**2) + np.arcsin(ends))
    share = (at[2:] - at[:-2]) / 2
    return float(np.sqrt(np.sum((force[1:-1] - right)**2 / share) / np.sum(right**2 / share)))


VARY = [{},
        {'smooth': [False], 'passes': [2, 1]},
        {'smooth': [True], 'passes': [1]},
        {'size': [2e-3, 5e-4]},
        {'size': [2e-3], 'smooth': [False], 'passes': [1]},
        {'timeStep': [.95, .4]},
        {'plane': ['stress']},
        {'bulkViscosity': [1.]},
        {'halo': [.05, .5]},
        {'collider': ['none', 'InsertionSortCollider']},
        {'threads': [2]},
        {'mesh': ['irregular']},
        {'element': ['smoothed']}]
ARGUMENTS = dict(duration=.7e-3, title='Hertz: error of the pressure, rms')
