"""FORD in two thirds of its time: python3 quick_ford.py ARGUMENTS OF FORD

FORD 7.0 colours the text of every source, though no page shows it with `source: false`, and finds out the types of its settings
again for every comment.
"""
import functools

import ford
import ford.settings
import ford.sourceform


def no_colours(text, *_):
    """The source as it is"""
    return text


ford.sourceform.highlight = no_colours
ford.settings.get_type_hints = functools.cache(ford.settings.get_type_hints)
ford.run()
