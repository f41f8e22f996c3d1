"""`python -m rotor`: the command line. Exit codes: 0 converged, 1 not converged, 2 bad input."""

import sys

from rotor.blas_threads import keep_one_blas_thread
from rotor.command.parser import build_parser
from rotor.terminal import run_command


def main(argv: list[str] | None = None) -> int:
    """Run one command; bad input gives one line on stderr."""
    keep_one_blas_thread()

    def run() -> int:
        parser = build_parser()
        if not (sys.argv[1:] if argv is None else argv):
            parser.print_help()
            return 0
        args = parser.parse_args(argv)
        return args.run(args)

    return run_command("rotor", run)


if __name__ == "__main__":
    raise SystemExit(main())
