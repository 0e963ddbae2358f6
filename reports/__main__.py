"""Measure: `python -m reports NAME [options]` for a question or one of its sections; without a name, all of them."""

import argparse
import sys
from collections.abc import Sequence

import twinform
from reports.harness.question import Question, question_of, questions
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.markdown import paragraphs

_MOST_SHOWN = 60


def main(arguments: Sequence[str]) -> int:
    """Measure, or list what can be measured.

    Returns:
        0, or 1 where something has no known cause, or 2 where nothing can be measured or there is no such name.
    """
    name = arguments[0] if arguments else ""
    question = questions().get(name) or question_of(name)
    if question is None:
        _list()
        return 2 if arguments else 0
    given = options(name, arguments[1:])
    names = given.section or ([name] if name in question.sections else list(question.sections))
    if unknown := [each for each in names if each not in question.sections]:
        print(f"{name} has no section {unknown[0]}: {', '.join(question.sections)}", file=sys.stderr)
        return 2
    return max(run(question, each, given) for each in names)


def run(question: Question, name: str, given: argparse.Namespace) -> int:
    """Measure a section; of all models it is written into the page, of a part of them it is printed."""
    section = question.section(name)
    if missing := section.missing:
        print(f"{name}: {missing}", file=sys.stderr)
        return 2
    seed = section.seed if given.seed is None else given.seed
    sample = Sample(given.every, tuple(given.file), seed, given.jobs, tuple(given.inputs))
    is_whole = sample.every == 1 and not sample.files and seed == section.seed
    found = section.measure(sample)
    text = section.text(question.sections[name], found, sample.every)
    if is_whole or given.write:
        twinform.write_atomically(question.page, question.text({name: text}))
        print(paragraphs(found.summary, f"written to {question.page}"))
    else:
        print(text)
    return _conclude(section, found, is_whole=is_whole)


def _conclude(section: Section, found: Findings, *, is_whole: bool) -> int:
    unused = section.known.unused() if section.known is not None and is_whole else []
    faults = [*found.faults, *unused]
    print(*faults[:_MOST_SHOWN], f"{len(faults)} without a reason", sep="\n", file=sys.stderr)
    return 1 if faults else 0


def _list() -> None:
    for question in questions().values():
        print(f"{question.name}: {question.title}")
        print(*(f"  {name:<18} {question.asked(name)}" for name in question.sections), sep="\n")


def options(name: str, arguments: Sequence[str]) -> argparse.Namespace:
    """The options of the command line."""
    parser = argparse.ArgumentParser(prog=f"python -m reports {name}")
    parser.add_argument("inputs", nargs="*", help="what a section reads beside the models, such as checkouts")
    parser.add_argument("--section", action="append", default=[], help="this section of the question alone")
    parser.add_argument("--every", type=int, default=1, help="one of so many models; a part is printed, not written")
    parser.add_argument("--file", action="append", default=[], help="models with this in their names, or a path")
    parser.add_argument("--seed", type=int, help="draw others, where something is drawn")
    parser.add_argument("--jobs", type=int, help="so many processes; as many as there are processors if not given")
    parser.add_argument("--write", action="store_true", help="write a part into the page as well")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
