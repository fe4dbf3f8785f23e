#!/usr/bin/python3
"""last_values FILE KIND PATH NUMBER...: checks the beginning of a list in the last JSON object of a kind in FILE.

PATH is a.b for nested objects. The numbers must agree within 2e-3.
"""

import json
import sys


def main():
    name, kind, path, *numbers = sys.argv[1:]
    with open(name, encoding="utf-8") as file:
        objects = [json.loads(line) for line in file]
    value = [found[kind] for found in objects if kind in found][-1]
    for key in path.split("."):
        value = value[key]
    near = len(value) >= len(numbers) and all(abs(v - float(n)) < 2e-3 for v, n in zip(value, numbers))
    sys.exit(None if near else f"{path} is {value}, not {numbers}")


if __name__ == "__main__":
    main()
