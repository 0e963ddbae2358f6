"""`python -m fuzz.run SECONDS [TARGET ...]`: fuzz targets of tests/fuzz one after the other, all if none is named.

Corpus, log and what fails (`crash-*`) of each go into out/fuzz/TARGET; a second run goes on where the first one ended.
Options of libFuzzer can follow `--`.
"""

import os
import resource
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

from fuzz.table import TARGETS

ROOT = Path(__file__).parents[1]
OUT = ROOT / "out" / "fuzz"
LOG = "log"
PROCESSOR = "processor seconds: "
"""Begins the last line of a log."""


def fuzz(name: str, seconds: int, options: list[str]) -> bool:
    """Run a target for so long; gives whether nothing was found."""
    folder = OUT / name
    corpus, words, target = folder / "corpus", folder / "words", TARGETS[name]
    corpus.mkdir(parents=True, exist_ok=True)
    for seed in target.seeds():
        if len(seed) <= target.longest:
            (corpus / sha256(seed).hexdigest()).write_bytes(seed)
    words.write_text("# words\n" + "".join(f"{_quoted(each)}\n" for each in sorted({*target.words()} - {""})))
    found = ROOT / "tests" / "fuzz" / "found" / name
    command = [
        sys.executable, ROOT / "fuzz" / "target.py", name, corpus, *([found] if found.is_dir() else ()),
        f"-dict={words}", f"-max_len={target.longest}", f"-max_total_time={seconds}", f"-artifact_prefix={folder}/",
        "-timeout=300", "-rss_limit_mb=1024", "-print_final_stats=1", *options,
    ]  # fmt: skip
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with (folder / LOG).open("ab") as log:
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        code = subprocess.run(command, stderr=log, check=False, env=environment).returncode
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        log.write(f"{PROCESSOR}{used:.0f}\n".encode())
    print(f"{name}: {'nothing was found' if not code else f'exit code {code}: see {folder / LOG}'}", flush=True)
    return not code


def _quoted(word: str) -> str:
    """A word as a dictionary of libFuzzer has it."""
    return '"' + "".join(chr(each) if chr(each).isalnum() else f"\\x{each:02x}" for each in word.encode()) + '"'


if __name__ == "__main__":
    seconds, *names = sys.argv[1:]
    cut = names.index("--") if "--" in names else len(names)
    results = [fuzz(name, int(seconds), names[cut + 1 :]) for name in names[:cut] or TARGETS]
    sys.exit(not all(results))
