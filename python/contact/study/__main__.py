"""contact study: many cases from one description."""
from __future__ import annotations

import argparse
import signal
import sys

from ..errors import ContactError


def main() -> int:
    """Do what the command line says; the result is the exit status: 0, 1 after an error, 2 with --strict when a case was not
    solved, 128 + n when signal n ended the study."""
    parser = argparse.ArgumentParser(prog="contact study", description="Computes the cases of a study that are not in its folder "
                                     "yet, and writes the results that it names; see doc/user/studies.md.")
    parser.add_argument("file", help="the study, in TOML")
    parser.add_argument("--explain", action="store_true", help="tell cases, time and size, and compute a few cases only")
    parser.add_argument("--workers", type=int, help="cases that are computed at the same time; default: all processors")
    parser.add_argument("--engine", choices=["threads", "processes"], default="threads", help="what the workers are")
    parser.add_argument("--scheduler", help="address of a scheduler of Dask, whose workers compute: tcp://HOST:8786")
    parser.add_argument("--folder", help="where cases are kept, in place of the one that the study names")
    parser.add_argument("--results", action="append", help="a file for the results: .nc, .zarr or .parquet; may be given again")
    parser.add_argument("--strict", action="store_true", help="exit with status 2 when a case was not solved")
    parser.add_argument("--quiet", action="store_true", help="tell errors only")
    asked = parser.parse_args()
    try:
        return _do(asked)
    except (ContactError, ValueError, OSError) as error:
        print(f"contact study: {error}", file=sys.stderr)
        return 1
    except ModuleNotFoundError as missing:
        print(f"contact study: the Python package {missing.name} is not found; it comes with: python3 -m pip install "
              "'SOURCES/python[study]'", file=sys.stderr)
        return 1


def _do(asked: argparse.Namespace) -> int:
    """What was asked for"""
    from ._file import StudyFile
    found = StudyFile(asked.file, asked.folder)
    study = found.study
    if asked.explain:
        print(study.explain(asked.workers, asked.scheduler))
        return 0
    caught: list[int] = []

    def end_soon(number: int, frame: object) -> None:
        # the tasks in hand are finished and kept; a second signal ends it at once
        caught.append(number)
        signal.signal(number, signal.SIG_DFL)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end_soon)
    study.compute(asked.workers, engine=asked.engine, scheduler=asked.scheduler, progress=False if asked.quiet else None,
                  stop=lambda: bool(caught))
    if caught:
        print(f"contact study: ended by a signal; what was computed is in {study.folder}, and the same command goes on",
              file=sys.stderr)
        return 128 + caught[0]
    files = list(asked.results or found.results)
    tally = study.write(*files)
    failed = tally.table()
    if not asked.quiet:
        print(tally)
        for file in files:
            print(f"{file} is written")
        if failed:
            print(failed)
    return 2 if asked.strict and failed else 0


if __name__ == "__main__":
    sys.exit(main())
