# SPDX-License-Identifier: Apache-2.0
"""Documents whose figures come from results.json. A block of a document, between `<!-- figures: NAME ... -->` and `<!-- end -->`, is
what its template in texts/ makes of the figures; the mark says of which commit they are.

In a template `{slam.kitti.ate_m:s2}` is a figure with two significant digits, `.low` or `.high` behind its name the least or
greatest of its runs; other layouts are Python's (`.1f`). `{peer....}` and `{by_hand....}` are of by_hand.json. `{=20 ms}` is what was given and not
measured. `{at}` says the commit in words, and is asked for beside a table."""

import re
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

BLOCK = re.compile(r"^<!-- figures: (?P<name>[\w.]+)[^\n]*? -->\n(?P<text>.*?)^<!-- end -->$", re.DOTALL | re.MULTILINE)
PLACE = re.compile(r"\{([^{}]+)\}")
NAME = re.compile(r"(?P<name>[a-z][\w.]*?)(?:\.(?P<end>low|high))?(?::(?P<layout>[^{}]+))?")
# Blocks of others, code: numbers in there are none of ours.
FOREIGN = re.compile(r"^<!-- parameters.*?^<!-- end -->$|^```.*?^```$", re.DOTALL | re.MULTILINE)
SAME_ENDS = re.compile(r"(?<![\d.,])(\d[\d.,]*) to \1(?![\d.,]*\d)")  # of a range, as shown: one number is enough
UNITS = "%|°|(?:px|cm|mm|µm|m|s|ms|MB|GB|deg|mrad|times|parts in)\\b"
QUANTITY = re.compile(rf"(?<![\w.{{=])\d[\d,.]*(?: ?± ?\d[\d.]*)? ?(?:{UNITS})")
CELL = re.compile(r"(?<=\|) (?P<cell>\d[^|]*?) (?=\|)")


class TextError(Exception):
    """Something is wrong with a template or a document."""


@dataclass(frozen=True)
class Use:
    """A figure in a template."""
    name: str
    end: str  # low, high or nothing: the median
    layout: str


def decimals_of(value, layout):
    """Of what is shown; below 0 if tens or more are rounded away. `s3`: three significant digits, after rounding, so that 9.96 is 10.0."""
    if not re.fullmatch(r"s\d", layout):
        return len(re.sub(r"\D", "", format(value, layout).partition(".")[2]))
    digits = int(layout[1:])
    return digits - 1 - (int(f"{value:.{digits - 1}e}".partition("e")[2]) if value else 0)


def show(value, layout):
    """Significant digits are plain, with commas for thousands: 38,512 and s3 are 38,500."""
    if re.fullmatch(r"s\d", layout):
        decimals = decimals_of(value, layout)
        shown = f"{round(value, decimals):,.{max(decimals, 0)}f}"
    else:
        shown = format(value, layout)
    return shown.lstrip("-") if not re.search("[1-9]", shown) else shown


def step(value, layout):
    """What the last digit that is shown stands for."""
    return 10.0 ** -decimals_of(value, layout)


def parse_use(text):
    found = NAME.fullmatch(text)
    if not found:
        raise TextError(f"'{text}' names no figure. A name is made of small letters, digits, points and underscores, as slam.kitti.ate_m:s2")
    return Use(found["name"], found["end"] or "value", found["layout"] or "g")


def uses_of(template):
    """In their order, but for what was given."""
    return [parse_use(place) for place in PLACE.findall(template) if place != "at" and not place.startswith("=")]


class Renderer:
    def __init__(self, store):
        self.store = store

    def number(self, use):
        if use.name in self.store.by_hand:
            return self.store.by_hand[use.name]["value"]
        if use.name not in self.store.figures:
            raise TextError(f"no figure is called '{use.name}': neither results.json nor by_hand.json has it")
        return getattr(self.store.figures[use.name], use.end)

    def commits(self, template):
        """In words: of the results, then of times where these are of others."""
        figures = [self.store.figures[use.name] for use in uses_of(template) if use.name in self.store.figures]
        results, times = (sorted({figure.commit for figure in figures if (figure.kind == "result") == wanted}) for wanted in (True, False))
        if not figures:
            return ""
        said = [f"measured at commit {', '.join(results)}"] if results else []
        if times and times != results:
            said.append(f"{'' if results else 'measured: '}times and memory at commit {', '.join(times)}")
        return "; ".join(said)

    def render(self, template):
        def replace(found):
            place = found[1]
            if place == "at":
                said = self.commits(template)
                return said[:1].upper() + said[1:]
            return place[1:] if place.startswith("=") else show(self.number(use := parse_use(place)), use.layout)
        return SAME_ENDS.sub(r"\1", PLACE.sub(replace, template))

    def block(self, name, template):
        said = self.commits(template)
        return f"<!-- figures: {name}{f' ({said})' if said else ''} -->\n{self.render(template)}<!-- end -->"


def blocks_of(text, where):
    """By name, the texts between the marks."""
    found = {}
    for block in BLOCK.finditer(text):
        if block["name"] in found:
            raise TextError(f"{where}: two blocks are called '{block['name']}'")
        found[block["name"]] = block["text"]
    if text.count("<!-- figures: ") != len(found):
        raise TextError(f"{where}: a mark `<!-- figures: NAME -->` at the start of a line has no `<!-- end -->` at the start of one")
    return found


class Documents:
    """The documents of a project and their templates, which lie in `texts` under the same names."""

    def __init__(self, store, root=ROOT, texts=HERE / "texts", not_measured=HERE / "not_measured.txt"):
        self.renderer, self.root, self.not_measured = Renderer(store), root, not_measured
        self.paths = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
        self.templates = {}
        for path in sorted(texts.rglob("*.md")):
            name = str(path.relative_to(texts))
            self.templates[name] = blocks_of(path.read_text(), f"texts/{name}")

    def all_uses(self):
        return [use for blocks in self.templates.values() for template in blocks.values() for use in uses_of(template)]

    def rewritten(self, name):
        """The document as it should be."""
        templates = self.templates.get(name, {})
        text = (self.root / name).read_text()
        found = blocks_of(text, name)
        for block in found.keys() ^ templates.keys():
            where = f"the document has no mark for '{block}' of its template" if block in templates else f"texts/{name} has no block '{block}'"
            raise TextError(f"{name}: {where}")
        return BLOCK.sub(lambda block: self.renderer.block(block["name"], templates[block["name"]]), text)

    def mend(self):
        """Writes the documents; the names of those that changed."""
        changed = []
        for name in self.templates:
            text = self.rewritten(name)
            if text != (self.root / name).read_text():
                (self.root / name).write_text(text)
                changed.append(name)
        return changed

    def complaints(self, experiments=None):
        """What is wrong with the texts. `experiments`: names of all; without them, whether each has its place is not asked."""
        said = []
        try:
            for path in self.paths:
                said += self.document_complaints(str(path.relative_to(self.root)), path.read_text())
            said += self.registry_complaints(experiments)
        except TextError as error:
            said.append(str(error))
        return said

    def document_complaints(self, name, text):
        said = []
        expected = self.rewritten(name)
        for number, (is_, should) in enumerate(zip(text.splitlines(), expected.splitlines()), 1):
            if is_ != should:
                said.append(f"{name}:{number}: differs from its template (texts/{name}) and results.json\n  has     {is_}\n  expects {should}")
                break
        else:
            if text != expected:
                said.append(f"{name}: has other lines than its template (texts/{name}) and results.json")
        for block, template in self.templates.get(name, {}).items():
            if re.search(r"^\|", template, re.MULTILINE) and "{at}" not in template:
                said.append(f"texts/{name}: the table '{block}' lacks {{at}}, which says of which commit it is")
            said += [f"texts/{name}: '{found}' in '{block}' is neither a figure nor given; write {{={found}}} if it is no measurement"
                     for _, found in unmarked(PLACE.sub(blank, template))]
        return said + self.unmarked_complaints(name, text)

    def unmarked_complaints(self, name, text):
        allowed = self.allowed(name)
        rest = FOREIGN.sub(blank, BLOCK.sub(blank, text))
        said = [f"benchmarks/figures/not_measured.txt: {name} does not say '{one}' outside of figures any more" for one in allowed if one not in rest]
        for one in allowed:
            rest = rest.replace(one, re.sub(r"[^\n]", " ", one))
        return said + [f"{name}:{number}: '{found}' is no figure of a template, nor does benchmarks/figures/not_measured.txt say that it is no measurement"
                       for number, found in unmarked(rest)]

    def allowed(self, name):
        lines = self.not_measured.read_text().splitlines() if self.not_measured.exists() else []
        rows = [line.partition(": ") for line in lines if line and not line.startswith("#")]
        return [text for document, _, text in rows if document == name]

    def registry_complaints(self, experiments):
        store, uses = self.renderer.store, {use.name for use in self.all_uses()}
        said = [f"by_hand.json: no template shows '{name}'" for name in store.by_hand if name not in uses]
        said += [f"by_hand.json: '{name}' does not say how it was taken" for name, row in store.by_hand.items() if not row.get("how")]
        if experiments is None:
            return said
        said += [f"results.json: '{name}' is of no experiment; measure again, or remove it"
                 for name in store.figures if name.rpartition(".")[0] not in experiments]
        shown = {name.rpartition(".")[0] for name in uses}
        return said + [f"no template shows a figure of the experiment '{name}'" for name in experiments if name not in shown]


def blank(found):
    """Keeps lines, so that their numbers stay right."""
    return re.sub(r"[^\n]", " ", found[0])


def unmarked(text):
    """Numbers with a unit, and cells of tables, but for the first of a row, that begin with a number: (line, what). Code, links and the
    heads of tables do not count."""
    text = re.sub(r"`[^`\n]*`|\[[^\]\n]*\]\([^)\n]*\)|^\|.*\n(?=\|-)", blank, text, flags=re.MULTILINE)
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        row = line.lstrip().startswith("|")
        cells = line.split("|", 2)
        line = f"|{cells[2]}" if row and len(cells) == 3 else line
        quantities = [one[0] for one in QUANTITY.finditer(line)]
        found += [(number, one) for one in quantities or ([one["cell"] for one in CELL.finditer(line)] if row else [])]
    return found
