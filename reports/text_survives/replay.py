"""One edit again, of a line of the page: `python -m reports.text_survives.replay LINE`; files: `out/edits/replay`."""

import json
import sys

from reports.text_survives.edit_jobs import OUT, Robot, again, converted, job_named, written


def main(line: str) -> int:
    """Try it, and leave its files; 1 where the edit does not win."""
    name, edited, robot, version, what = json.loads(line)
    model = converted(Robot(job_named(name, edited), robot, version))
    if isinstance(model, str):
        print(model, file=sys.stderr)
        return 1
    text, tried = again(model, what)
    folder = written(model, text, tried, OUT / "replay")
    print(tried.verdict.outcome, *tried.verdict.differences, *tried.verdict.rules, folder, sep="\n")
    return 1 if tried.verdict.is_fault else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
