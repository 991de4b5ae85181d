"""Embree 4 through embreex, for `cargo xtask rays`: answers questions on standard input.

Usage: embree_peer.py FOLDER THREADS, the folder holding what the chore wrote: positions.bin (f32, three
a vertex), triangles.bin (u32, three a triangle) and sets of rays (f32: origin, direction, t_max).

First line out: seconds of processor and of the clock for the tree, bytes that it added to the memory.
Then, for every line `SET QUERY [away]`: seconds of processor for all rays of the set, and how many hit;
`away`: from 1000 units off, where there is nothing to hit.
"""

import os
import sys
import time

FOLDER, THREADS = sys.argv[1], int(sys.argv[2])
os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:THREADS])

import numpy as np  # noqa: E402: after the threads are chosen
from embreex.mesh_construction import TriangleMesh  # noqa: E402
from embreex.rtcore_scene import EmbreeScene  # noqa: E402


def load(name, kind, columns):
    return np.fromfile(os.path.join(FOLDER, name + ".bin"), dtype=kind).reshape(-1, columns)


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def main():
    positions, triangles = load("positions", "<f4", 3), load("triangles", "<i4", 3)
    before = resident()
    processor, clock = time.process_time(), time.perf_counter()
    scene = EmbreeScene()
    mesh = TriangleMesh(scene, positions, triangles)
    nowhere = np.full((1, 3), 1000, np.float32)
    scene.run(nowhere, nowhere, query="INTERSECT")
    processor, clock = time.process_time() - processor, time.perf_counter() - clock
    print(processor, clock, resident() - before, flush=True)
    sets = {}
    for line in sys.stdin:
        name, query, *away = line.split()
        if name not in sets:
            rays = load(name, "<f4", 7)
            sets[name] = [np.ascontiguousarray(a) for a in (rays[:, :3], rays[:, 3:6], rays[:, 6])]
        origins, directions, ends = sets[name]
        if away:
            origins = origins + np.float32(1000)
        start = time.process_time()
        answer = scene.run(origins, directions, dists=ends, query=query)
        seconds = time.process_time() - start
        print(seconds, np.count_nonzero(answer >= 0), flush=True)
    del mesh


main()
