"""Which sources of a target may be compiled as one, for builds in bundles (MyotactBundles.cmake).

Usage: bundle_sources.py MOST SOURCE...   One line a source: the number of its bundle, in the order given.

Two sources share a bundle of at most MOST unless a name that one declares in its unnamed namespace is a word of the
other, or of a header of ours that it includes: there it could be declared again or mean something else. Names of
functions meet only where they are called or declared: a variable may be called as another source's function.
"""

import functools
import os
import re
import sys

COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.S | re.M)
FUNCTION = re.compile(r"^(?:template <[^\n]*>\s*)?[A-Za-z_][\w:<>,&*\[\] ]*?[ &*](\w+)\(", re.M)
NAME = (
    re.compile(r"^(?:struct|class|enum class|enum|union) (\w+)|^using (\w+) =", re.M),
    re.compile(r"^(?:inline |static |constexpr |const |thread_local )+[^\n=({;]*?(\w+)(?:\[[^\n]*?\])? ?[={(;]", re.M),
    re.compile(r"^[A-Z]\w+(?:::\w+)*(?:<[^\n]*>)? (\w+)(?: = |;|\{|\()", re.M),
)
ROOTS = [os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", folder) for folder in ("src", "tools", "tests")]


def called(name):
    """The word by which a function is known: as it is followed by its arguments."""
    return name + "("


def words_of(text):
    """Identifiers, but for members and qualified names; those that are followed by ( also as called()."""
    found = re.findall(r"(?<!\.)(?<!->)(?<!::)\b([A-Za-z_]\w*)(\(?)", COMMENT.sub(" ", text))
    return {name for name, _ in found} | {called(name) for name, paren in found if paren}


@functools.lru_cache(None)
def header(name):
    """Words of a header of ours and of those that it includes."""
    for root in ROOTS:
        path = os.path.join(root, name)
        if os.path.exists(path):
            return all_words(open(path, encoding="utf-8").read())
    return set()


def all_words(text):
    words = words_of(text)
    for name in re.findall(r'^#include "([^"]+)"', text, re.M):
        words |= header(name)
    return words


def read(path):
    """What a source declares in its unnamed namespace, and all words that it sees."""
    text = open(path, encoding="utf-8").read()
    declared = set(re.findall(r"^#define (\w+)[( ]+\S", text, re.M))  # a macro lasts to the end of the bundle
    for body in UNNAMED.findall(text):
        body = COMMENT.sub(" ", body)
        declared.update(called(name) for name in FUNCTION.findall(body))
        for pattern in NAME:
            declared.update(name for found in pattern.finditer(body) for name in found.groups() if name)
    return declared, all_words(text)


def main():
    most = int(sys.argv[1])
    bundles = []  # [declared, words, count]
    for path in sys.argv[2:]:
        declared, words = read(path)
        for number, bundle in enumerate(bundles):
            if bundle[2] < most and not declared & bundle[1] and not words & bundle[0]:
                break
        else:
            number = len(bundles)
            bundles.append([set(), set(), 0])
        bundles[number][0] |= declared
        bundles[number][1] |= words
        bundles[number][2] += 1
        print(number)


main()
