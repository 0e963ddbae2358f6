"""One edit again, with a line of the page: `python -m reports.edits.replay LINE`; files are in `out/edits/replay`."""

import json
import sys

from reports.edits.jobs import OUT, again, converted, job_named
from reports.harness.files import kept


def main(line: str) -> int:
    """Try it, and leave its files; 1 where the edit does not win."""
    name, robot, version, what = json.loads(line)
    model = converted(job_named(name), robot, version)
    if isinstance(model, str):
        print(model, file=sys.stderr)
        return 1
    edited, tried = again(model, what)
    place = OUT / "replay"
    here, there = ("sdf", "urdf") if model.job.is_urdf else ("urdf", "sdf")
    kept(place / f"before.{here}", model.before.text.decode())
    kept(place / f"edited.{here}", edited.decode())
    kept(place / f"result.{there}", tried.verdict.result or "")
    print(tried.verdict.outcome, *tried.verdict.differences, *tried.verdict.rules, place, sep="\n")
    return 1 if tried.verdict.is_fault else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
