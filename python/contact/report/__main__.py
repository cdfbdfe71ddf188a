"""contact report EXPNAM | --serve [FOLDER]"""
from __future__ import annotations

import argparse
import sys

from .page import write_page
from .read import MissingResults, find_results, warning_of_run
from .server import DEFAULT_PORT, serve


def port_number(text: str) -> int:
    """Argument type: a valid port number"""
    if text.isascii() and text.isdigit() and int(text) < 65536:
        return int(text)
    raise argparse.ArgumentTypeError("%r is not a port number; port numbers are 0 to 65535" % text)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="contact report", description=(
        "Results of an experiment as one HTML file, or a page on this machine to check, run and view experiments."))
    parser.add_argument("experiment", nargs="?", metavar="EXPNAM", help="experiment that was run with contact --hdf5")
    parser.add_argument("-o", "--output", metavar="FILE", help="name of the HTML file; default EXPNAM.html")
    parser.add_argument("--with", dest="other", metavar="OTHER", help="another experiment, to be compared with the first")
    parser.add_argument("--serve", nargs="?", const=".", metavar="FOLDER",
                        help="serve the .inp files of a folder (default: this one) on the loopback address")
    parser.add_argument("--port", type=port_number, default=DEFAULT_PORT,
                        help="port of the server, 0 for any free one (default %(default)s)")
    options = parser.parse_args(arguments)
    if (options.experiment is None) == (options.serve is None):
        parser.error("name an experiment, or use --serve")
    if options.serve is not None and (options.other is not None or options.output is not None):
        parser.error("--with and --output go with an experiment, not with --serve")
    try:
        if options.serve is not None:
            serve(options.serve, options.port)
        else:
            name = find_results(options.experiment)
            other = find_results(options.other) if options.other is not None else None
            print(write_page(name, options.output, other))
            for warning in filter(None, [warning_of_run(path) for path in (name, other) if path]):
                print("contact report: %s" % warning, file=sys.stderr)
    except (MissingResults, OSError, RuntimeError) as reason:  # RuntimeError: from h5py, if a file cannot be closed
        print("contact report: %s" % reason, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
