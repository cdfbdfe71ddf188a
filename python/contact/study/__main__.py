"""contact study: many cases from one description."""
from __future__ import annotations

import argparse
import signal
import sys

from ..errors import ContactError


def main() -> int:
    """Run the command line. Returns the exit status: 0, 1 after an error, 2 with --strict if a case was not solved, 128 + n if
    signal n ended the study."""
    parser = argparse.ArgumentParser(prog="contact study", description="Computes the cases of a study that are not yet in its "
                                     "folder, and writes its results; see doc/user/studies.md.")
    parser.add_argument("file", help="the study, in TOML")
    parser.add_argument("--explain", action="store_true", help="report cases, time and size, computing only a few cases")
    parser.add_argument("--workers", type=int, help="number of simultaneous cases; default: number of processors")
    parser.add_argument("--engine", choices=["threads", "processes"], default="threads", help="kind of the workers")
    parser.add_argument("--scheduler", help="address of a scheduler of Dask, whose workers compute: tcp://HOST:8786")
    parser.add_argument("--folder", help="folder of the computed cases, instead of that of the study")
    parser.add_argument("--results", action="append", help="a file for the results: .nc, .zarr or .parquet; can be repeated")
    parser.add_argument("--strict", action="store_true", help="exit with status 2 if a case was not solved")
    parser.add_argument("--quiet", action="store_true", help="report errors only")
    options = parser.parse_args()
    try:
        return _run(options)
    except (ContactError, ValueError, OSError) as error:
        print(f"contact study: {error}", file=sys.stderr)
        return 1
    except ModuleNotFoundError as missing:
        print(f"contact study: the Python package {missing.name} is not found; it comes with: python3 -m pip install "
              "'SOURCES/python[study]'", file=sys.stderr)
        return 1


def _run(options: argparse.Namespace) -> int:
    """Compute or explain the study"""
    from ._file import StudyFile
    found = StudyFile(options.file, options.folder)
    study = found.study
    if options.explain:
        print(study.explain(options.workers, options.scheduler))
        return 0
    caught: list[int] = []

    def end_soon(number: int, frame: object) -> None:
        # running tasks are finished and stored; a second signal ends the process at once
        caught.append(number)
        signal.signal(number, signal.SIG_DFL)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end_soon)
    study.compute(options.workers, engine=options.engine, scheduler=options.scheduler, progress=False if options.quiet else None,
                  stop=lambda: bool(caught))
    if caught:
        print(f"contact study: ended by a signal; computed cases are in {study.folder}; repeat the command to continue",
              file=sys.stderr)
        return 128 + caught[0]
    files = list(options.results or found.results)
    tally = study.write(*files)
    failed = tally.table()
    if not options.quiet:
        print(tally)
        for file in files:
            print(f"{file} is written")
        if failed:
            print(failed)
    return 2 if options.strict and failed else 0


if __name__ == "__main__":
    sys.exit(main())
