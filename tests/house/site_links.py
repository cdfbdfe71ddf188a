#!/usr/bin/env python3
"""Every page of the manual is in the site, and every link of the site leads to an existing file and anchor

Usage: site_links.py SITE DOC
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """Links of a page, and its anchors"""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.places.add(value)
            elif name in ("href", "src") and value:
                self.links.append(value)


def target_of(link, page):
    """File and anchor of a link; None for external addresses"""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    return ((page.parent / path).resolve() if path else page), urllib.parse.unquote(parts.fragment)


def main():
    """Report broken links and missing pages"""
    site, doc = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    pages = {path: Page(path) for path in site.rglob("*.html")}
    wrong = [f"{source.relative_to(doc)} has no page in the site" for source in doc.rglob("*.md")
             if source.name != "ford.md" and (site / source.relative_to(doc)).with_suffix(".html") not in pages]
    count = 0
    for path, page in pages.items():
        for link in page.links:
            target = target_of(link, path)
            if target is None:
                continue
            count += 1
            file, place = target
            if not file.exists():
                wrong.append(f"{path.relative_to(site)}: there is no {link}")
            elif place and file in pages and place not in pages[file].places:
                wrong.append(f"{path.relative_to(site)}: no place {link}")
    print("\n".join(wrong))
    print(f"{len(pages)} pages, {count} links, {len(wrong)} wrong")
    if wrong or count < 1000:
        sys.exit(1)


if __name__ == "__main__":
    main()
