"""Cases of a ball on a plane for tests of runs, not of results"""
CASE = """3
203100
0022020
0{g}01201
{limits}
{fn} 0.001 0 0
0.3 0.3
0 {dx} 1000
0.28 0.28 82000 82000
1
{n} {n} -1 -1 {dx} {dx}
1 1
0.01 0 0.01 0 0 0
"""


def case(n=20, g=0, limits="999 100 30 1 1e-5", fn=100):
    return CASE.format(n=n, dx=2 / n, g=g, limits=limits, fn=fn)


def endless(n=80):
    """ConvexGS with a tolerance below round-off: a million sweeps on any machine"""
    return case(n, g=2, limits="999999 100 30 1 1e-20\n0.9 1.0 0 0.5", fn=2000)
