"""The report for CI systems that show tests: JUnit XML, as Jenkins, GitLab and others read it."""

from collections.abc import Sequence

from twinform.diagnostics.diagnostic import Diagnostic, Severity
from twinform.diagnostics.reporters.file_findings import FileFindings, printable

_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def junit(files: Sequence[FileFindings]) -> str:
    """A suite for each file, and in it a test for each finding, or one that passed.

    An error is a failure. A warning or a note is a skipped test, so that it is seen and fails nothing: `check` ends
    with 0 then, too.
    """
    counts = _counts([each for file in files for each in file.diagnostics], sum(not file.diagnostics for file in files))
    suites = "".join(map(_suite, files))
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<testsuites name="twinform"{counts}>\n{suites}</testsuites>\n'


def _suite(file: FileFindings) -> str:
    tests = "".join(_test(each, file.path) for each in file.diagnostics)
    tests = (
        tests or f"    <testcase{_attributes(name='no findings', classname=file.path, file=file.path, time='0')}/>\n"
    )
    counts = _counts(file.diagnostics, not file.diagnostics)
    return f"  <testsuite{_attributes(name=file.path)}{counts}>\n{tests}  </testsuite>\n"


def _counts(found: Sequence[Diagnostic], passed: int) -> str:
    failures = sum(each.is_error for each in found)
    return _attributes(
        tests=str(len(found) + passed),
        failures=str(failures),
        errors="0",
        skipped=str(len(found) - failures),
        time="0",
    )


def _test(diagnostic: Diagnostic, file: str) -> str:
    where, name = diagnostic.location, diagnostic.location.file or file
    column = f":{where.column}" if where.column else ""
    place = f"{where.line}{column}" if where.line else ""
    test = _attributes(
        # Rule, place and path, so that two findings never have one name.
        name=" ".join(part for part in (diagnostic.rule.name, place, where.path) if part),
        classname=file,
        file=name,
        line=str(where.line),
        time="0",
    )
    body = "\n".join(
        part
        for part in (
            f"{printable(name)}{f':{place}' if place else ''}: {diagnostic.severity}: {diagnostic.message}",
            where.path and f"at {where.path}",
            diagnostic.help and f"help: {diagnostic.help}",
        )
        if part
    )
    return f"    <testcase{test}>\n      {_outcome(diagnostic, body)}\n    </testcase>\n"


def _outcome(diagnostic: Diagnostic, body: str) -> str:
    what = _attributes(type=f"{diagnostic.severity}: {diagnostic.rule.name}", message=diagnostic.message)
    # A skipped test is shown by Jenkins and GitLab and fails nothing, like the exit code of a
    # warning.
    tag = "failure" if diagnostic.severity is Severity.ERROR else "skipped"
    return f"<{tag}{what}>{_escaped(body)}</{tag}>"


def _attributes(**values: str) -> str:
    return "".join(f' {name}="{_escaped(printable(value))}"' for name, value in values.items())


def _escaped(text: str) -> str:
    """Text or a value; what XML has no character for is escaped as the other reports do it."""
    # Names from hostile files have characters that XML has no form for. This is the only difficult
    # part, and `junitparser` and `junit-xml` do not do it.
    return "\n".join(map(printable, text.split("\n"))).translate(_ENTITIES)
