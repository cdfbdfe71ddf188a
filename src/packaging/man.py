#!/usr/bin/env python3
"""Writes the man page of the program, made from its own help. Usage: man.py CONTACT > contact.1"""
import re
import subprocess
import sys


def escaped(text):
    """Text as roff shows it unchanged"""
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.MULTILINE)


def page(help_text, version):
    """The page from the answers to --help and --version"""
    usage, _, rest = help_text.partition("\n\n")
    title, _, rest = rest.partition("\n\n")
    words, _, options = rest.partition("\nOptions\n")
    options, _, status = options.partition("\n\n")
    parts = [f'.TH CONTACT 1 "" "{version.splitlines()[0]}" "User Commands"',
             ".SH NAME", escaped("contact - " + title[0].lower() + title[1:].rstrip(".\n")),
             ".SH SYNOPSIS", ".nf", escaped(usage.replace("Usage: ", "").replace("       contact", "contact")), ".fi",
             ".SH DESCRIPTION", ".nf", escaped(words.strip("\n")), ".fi"]
    parts.append(".SH OPTIONS")
    for entry in re.split(r"\n(?=  -)", options.rstrip("\n")):
        name, _, meaning = entry.strip().partition("  ")
        parts += [".TP", ".B " + escaped(name), escaped(" ".join(meaning.split()))]
    return "\n".join([*parts, ".SH EXIT STATUS", escaped(status.strip("\n"))]) + "\n"


if __name__ == "__main__":
    print(page(*(subprocess.run([sys.argv[1], option], capture_output=True, text=True, check=True).stdout
                 for option in ("--help", "--version"))), end="")
