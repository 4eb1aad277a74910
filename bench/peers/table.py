"""Joins measurements into one file and one table. run.sh calls it.

    table.py JSON BUILD PART...

Exit code 1: one of raylane's answers is wrong.
"""

import json
import pathlib
import sys


sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import machine  # noqa: E402


def load(parts):
    """Returns all rows, and Embree's version or an empty string."""
    rows, embree = [], ""
    for part in parts:
        with open(part) as file:
            document = json.load(file)
        rows += document["rows"]
        embree = document.get("embree") or embree
    return rows, embree


def users(row):
    """Returns the result of raylane's library or program, as users call it."""
    return next((result for result in row["by"] if result["name"] == row.get("own")),
                row["by"][0])


def best_peer(row):
    peers = [result for result in row["by"]
             if not result["name"].startswith(("raylane", "library"))]
    if not peers:
        return None
    best = max if row["unit"] == "Mrays/s" else min
    return best(peers, key=lambda result: result["median"])


def cells(row):
    engine, own, peer = row["by"][0], users(row), best_peer(row)
    number = "%.2f" if row["unit"] == "Mrays/s" else "%.3f"
    wrong = ["%d" % result["wrong"] if result and "wrong" in result else ""
             for result in (engine, peer)]
    return [row["scene"], row["what"], row.get("isa", ""), str(row["threads"]), row["unit"],
            number % engine["median"] if own is not engine else "", number % own["median"],
            number % peer["median"] if peer else "",
            peer["name"] if peer else "", "%.2f" % row["ratio"] if peer else "", *wrong]


def print_table(rows):
    head = ["scene", "measured", "isa", "threads", "unit", "engine", "raylane", "best peer", "peer", "ratio",
            "wrong", "wrong of peer"]
    table = [head] + [cells(row) for row in rows]
    widths = [max(len(line[column]) for line in table) for column in range(len(head))]
    numbers = {3, 5, 6, 7, 9, 10, 11}
    for line in table:
        print("  ".join(cell.rjust(width) if column in numbers else cell.ljust(width)
                        for column, (cell, width) in enumerate(zip(line, widths))).rstrip())


def gain(row, result):
    more, alone = result["median"], result["alone"]
    return more / alone if row["unit"] == "Mrays/s" else alone / more


def print_scaling(rows):
    """Prints the speed with several threads relative to one thread. The runs alternated."""
    for row in rows:
        results = [result for result in (users(row), best_peer(row))
                   if result and "alone" in result]
        if results:
            print("%s, %s: speed with %d threads relative to one: %s" % (
                row["scene"], row["what"], row["threads"],
                ", ".join("%.2f for %s" % (gain(row, result), result["name"])
                          for result in results)))


def main():
    output, build, *parts = sys.argv[1:]
    rows, embree = load(parts)
    description = {**machine.described(build), **machine.versions_of_peers()}
    if embree:
        description["Embree"] = embree
    for row in rows:
        row["scene"] = pathlib.PurePath(row["scene"]).name if row["scene"].endswith(
            (".nff", ".json")) else row["scene"]
    with open(output, "w") as file:
        json.dump({"machine": description, "rows": rows}, file, indent=2)
    isas = [isa for isa in dict.fromkeys(row.get("isa", "") for row in rows) if isa]
    print("\n%s" % machine.small_print({"machine": description}, isas))
    print("Medians. engine: raylane's engine on internal arrays. raylane: the library or the program. ratio: speed of"
          "\nraylane relative to the best peer. wrong, wrong of peer: answers of the engine and of the best peer that"
          "\ncertified arithmetic refutes; for an image, pixels that differ from raylane's.\n")
    print_table(rows)
    print()
    print_scaling(rows)
    print(output)
    refuted = [row for row in rows if row["by"][0].get("wrong", 0) != 0]
    sys.exit(1 if refuted else 0)


main()
