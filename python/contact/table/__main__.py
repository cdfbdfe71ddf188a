"""contact table: makes a table of creep forces, or describes one."""
from __future__ import annotations

import argparse
import sys

from ..errors import ContactError


def main() -> int:
    """Run the command line. Returns the exit status: 0, or 1 after an error."""
    parser = argparse.ArgumentParser(prog="contact table", description="Makes a table of creep forces for elliptic contacts, or "
                                     "for two half ellipses, from which programs interpolate in less than a microsecond; see "
                                     "doc/user/tables.md.")
    parser.add_argument("file", help="the table")
    parser.add_argument("--about", action="store_true", help="describe an existing table")
    parser.add_argument("--tolerance", type=float, default=0.01, help="largest error relative to mu Fn; default %(default)s")
    parser.add_argument("--ratio", type=float, nargs=2, default=[0.2, 5.0], metavar=("LOW", "HIGH"),
                        help="smallest and largest a/b; default 0.2 5")
    parser.add_argument("--offset", type=float, default=0.0, help="of two half ellipses: the largest "
                        "|bpos - bneg|/(bpos + bneg); default 0: ellipses")
    parser.add_argument("--spin", type=float, default=float("inf"), help="largest spin as G a b c KP |phi|/(mu Fn), "
                        "c = sqrt(a b), KP about Kalker's C23; default: all")
    parser.add_argument("--poisson", type=float, default=0.28, help="Poisson ratio of both bodies; default %(default)s")
    parser.add_argument("--elements", type=int, default=0, help="elements along each side of a contact; default: by the tolerance")
    parser.add_argument("--points", type=int, default=10000, help="number of random points of the check; default %(default)s")
    parser.add_argument("--most-cases", type=int, default=3_000_000, help="number of solutions after which the search is "
                        "abandoned; default %(default)s")
    parser.add_argument("--workers", type=int, help="number of threads; default: number of processors")
    parser.add_argument("--quiet", action="store_true", help="report errors only")
    options = parser.parse_args()
    try:
        if options.about:
            from ._look_up import Table
            with Table(options.file) as table:
                print(table.facts)
            return 0
        from ._build import Plan, build
        plan = Plan(options.tolerance, (options.ratio[0], options.ratio[1]), options.offset, options.poisson, options.spin,
                    options.elements, options.points, options.most_cases)
        facts = build(options.file, plan, workers=options.workers,
                      tell=lambda text: None if options.quiet else print(text, file=sys.stderr))
    except (ContactError, OSError) as error:
        print(f"contact table: {error}", file=sys.stderr)
        return 1
    except ModuleNotFoundError as missing:
        print(f"contact table: the Python package {missing.name} is not found; it comes with: python3 -m pip install "
              "'SOURCES/python[table]'", file=sys.stderr)
        return 1
    if not options.quiet:
        print(f"{options.file} is written: {facts}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
