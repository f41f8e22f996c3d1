"""`python -m rotor`: the command line. Exit codes: 0 converged, 1 not converged, 2 bad input."""

import sys

from rotor.blas_threads import keep_one_blas_thread
from rotor.command.parser import build_parser


def main(argv: list[str] | None = None) -> int:
    """Run one command; bad input gives one line on stderr."""
    keep_one_blas_thread()
    try:
        args = build_parser().parse_args(argv)
        return args.run(args)
    except (ValueError, FileNotFoundError) as error:
        print(f"rotor: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # The reader of a pipe has seen enough.
        sys.stderr.close()
        return 0
    except KeyboardInterrupt:
        print("rotor: stopped", file=sys.stderr)
        return 130


if __name__ == "__main__":
    raise SystemExit(main())
