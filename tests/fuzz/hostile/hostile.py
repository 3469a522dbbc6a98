#!/usr/bin/env python3
"""Runs relamp on what is not as it should be: five kinds of cases, made up from small good files.

    hostile.py build/asan/apps/cli/relamp build/asan/tests/fuzz/seeds --keep /tmp/kept

A case fails where a signal or a sanitizer ends the program, where it takes more than 20 s of a processor or 2 GiB, ends with
another code than 0, 1 or 2, refuses without a sentence that names the file, speaks in words of a library, writes a NaN or
leaves anything half written. The same seed makes the same cases. See docs/dev/testing.md.
"""

import argparse
import collections
import concurrent.futures
import itertools
import pathlib
import random
import shutil
import sys
import tempfile
import time

from case import try_case
from kinds import KINDS, Seeds


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="relamp, sanitized or not")
    parser.add_argument("seeds", type=pathlib.Path, help="the folder that relamp_fuzz_seeds writes")
    parser.add_argument("--kind", choices=KINDS, action="append", help="of these alone (repeatable)")
    parser.add_argument("--cases", type=int, default=1200, help="of a kind, at most [1200]")
    parser.add_argument("--seconds", type=float, default=1e9, help="of all kinds together")
    parser.add_argument("--seed", type=int, default=22)
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--only", default="", help="cases whose name has this in it")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the files of cases that fail")
    return parser.parse_args()


def main():
    asked = arguments()
    program = str(asked.program.resolve())
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="relamp-hostile-", dir="/dev/shm"))
    if asked.keep:
        asked.keep.mkdir(parents=True, exist_ok=True)
    try:
        (scratch / "seeds").mkdir()
        seeds = Seeds(asked.seeds, program, scratch / "seeds")
        return table(asked, run_all(asked, program, seeds, scratch))
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def run_all(asked, program, seeds, scratch):
    """What became of each kind: seconds, and outcomes and failures counted."""
    results = {}
    kinds = asked.kind or list(KINDS)
    for kind in kinds:
        start = time.monotonic()
        cases = (case for case in KINDS[kind](seeds, random.Random(asked.seed)) if asked.only in case.what)
        counts = collections.Counter()

        def one(numbered):
            number, case = numbered
            if time.monotonic() - start > asked.seconds / len(kinds):
                return
            outcome, wrong = try_case(program, case, scratch / f"{number}-{kind}", asked.keep)
            counts["cases"] += 1
            counts[outcome.code if outcome.code in (0, 1, 2) else "else"] += 1
            if wrong:
                counts["failed"] += 1
                print(f"FAILED {case.what}: {wrong} (exit {outcome.code}, {outcome.seconds:.1f} s)", flush=True)
        with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
            list(pool.map(one, enumerate(itertools.islice(cases, asked.cases))))
        results[kind] = counts, time.monotonic() - start
    return results


def table(asked, results):
    print(f"\nseed {asked.seed}\n{'kind':10}{'cases':>8}{'exit 0':>8}{'1':>8}{'2':>8}{'signal':>8}{'failed':>8}{'seconds':>9}")
    for kind, (counts, seconds) in results.items():
        print(f"{kind:10}" + "".join(f"{counts[key]:8}" for key in ("cases", 0, 1, 2, "else", "failed")) + f"{seconds:9.0f}")
    total = sum((counts for counts, _ in results.values()), collections.Counter())
    print(f"{'all':10}" + "".join(f"{total[key]:8}" for key in ("cases", 0, 1, 2, "else", "failed")))
    return 1 if total["failed"] or not total["cases"] else 0


if __name__ == "__main__":
    sys.exit(main())
