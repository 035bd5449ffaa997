#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief manual
"""Text in the language of the locale or of --language; equal data in each."""
import csv
import functools
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, PROFILES, ROOT, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, good, run_all  # noqa: E402
from pages import WHOLE, expect_width  # noqa: E402
from runs import FOUR, PAPER, without_seconds  # noqa: E402

ENGLISH, ITALIAN = "print this help", "stampa questo aiuto"


def test_environment():
    """LC_ALL, LC_MESSAGES, LANG and LANGUAGE choose as in gettext, also for a missing locale"""
    none = {"LC_ALL": None}
    for env, wanted in (({"LC_ALL": "it_IT.UTF-8"}, ITALIAN), ({"LC_ALL": "it_IT"}, ITALIAN), ({"LC_ALL": "it"}, ITALIAN),
                        ({**none, "LANG": "it_CH.utf8"}, ITALIAN), ({**none, "LC_MESSAGES": "it_IT.UTF-8"}, ITALIAN),
                        ({"LC_ALL": "C.UTF-8"}, ENGLISH), ({"LC_ALL": "C", "LANGUAGE": "it"}, ENGLISH), (none, ENGLISH),
                        ({"LC_ALL": "it_IT.UTF-8", "LANGUAGE": "en"}, ENGLISH),
                        ({"LC_ALL": "it_IT.UTF-8", "LANGUAGE": "en_GB:it"}, ITALIAN),
                        ({**none, "LANG": "it_IT.UTF-8", "LC_MESSAGES": "C"}, ENGLISH),
                        ({**none, "LANG": "C.UTF-8", "LANGUAGE": "it"}, ITALIAN),
                        ({**none, "LANG": "de_DE.UTF-8", "LANGUAGE": "de:it_IT"}, ITALIAN),
                        ({"LC_ALL": "C", "LANG": "it_IT.UTF-8"}, ENGLISH), ({"LC_ALL": "italic.UTF-8"}, ENGLISH),
                        ({"LC_ALL": "xx_YY.UTF-8"}, ENGLISH)):
        expect_in(wanted, good("--help", env=env).out, env)


def test_option():
    """--language overrides the environment, and later errors are in its language; an unknown word is refused"""
    for env in ("C", "C.UTF-8", "it_IT.UTF-8", "xx_YY"):
        expect_in(ITALIAN, good("--language", "it", "--help", env={"LC_ALL": env}).out, env)
        expect_in(ENGLISH, good("--help", "--language=en", env={"LC_ALL": env}).out, env)
    expect_equal(ceduo("--language", "fr").status, USAGE)


def test_system_errors():
    """Errors of the system are Italian without a locale of the machine"""
    expect_in("none.yaml: non si può leggere: file o cartella inesistente", ceduo("--language", "it", "-b", "none.yaml").err)
    expect_equal(ceduo("--language", "it", "-b", "-o", "/dev/full", "-n", 5, "-s", "uncertainty=none", PAPER).err,
                 "/dev/full: spazio esaurito sul disco\n")


def test_without_translation():
    """A program without its installation has only the installed translation: without it the text is English"""
    installed = re.search(rb"\0(/[^\0]*/locale)\0", Path(CEDUO).read_bytes())
    expect(installed, "no folder of an installation in the program")
    wanted = ITALIAN if Path(os.fsdecode(installed[1]), "it/LC_MESSAGES/ceduo.mo").exists() else ENGLISH
    with Folder() as f:
        program = shutil.copy2(CEDUO, f.path / "ceduo")
        env = environment(LC_ALL="it_IT.UTF-8")
        done = subprocess.run([program, "--language", "it", "--help"], env=env, capture_output=True, text=True, check=True)
        expect_in(wanted, done.stdout)
        expect_equal(done.stderr, "")


@functools.cache
def shipped(*words):
    """Cached text of a file that never changes."""
    return run_both(*words)


def run_both(*words):
    """Return output in English and in Italian."""
    return [good(*words, "--language", language).out for language in ("en", "it")]


def test_whole():
    """Every marked text has a translation without guesses, and formats agree: make po, then src/po/it.po"""
    with Folder() as f:
        # The template of this tree, whatever was built from it; made by the Makefile's own command.
        env = {k: v for k, v in environment().items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        made = subprocess.run(["make", "-s", "-C", ROOT, f"TEMPLATE={f.path}/ceduo.pot", f"{f.path}/ceduo.pot"], env=env,
                              capture_output=True, text=True, check=False)
        expect_equal(made.returncode, 0, made.stderr)
        for language in sorted((ROOT / "src/po").glob("*.po")):
            merged = f.path / language.name
            subprocess.run(["msgmerge", "-q", "-N", "-o", merged, language, f.path / "ceduo.pot"], check=True)
            done = subprocess.run(["msgfmt", "-c", "--statistics", "-o", os.devnull, merged], env=env, capture_output=True,
                                  text=True, check=False)
            expect(re.fullmatch(r"\d+ translated messages\.", done.stderr.strip().splitlines()[-1]), language.name, done.stderr)
            missing = subprocess.run(["msgattrib", "--untranslated", "--no-wrap", merged], capture_output=True, text=True,
                                     check=True).stdout
            expect_equal(missing, "", "not translated")
            fuzzy = subprocess.run(["msgattrib", "--only-fuzzy", "--no-obsolete", language], capture_output=True, text=True,
                                   check=True).stdout
            expect_equal(fuzzy, "", "guessed")


def glossary(name):
    """Return the rows of the glossary."""
    with open(ROOT / "src/po" / name, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def english(term):
    """Match a term of the sources as a word, or its plural; not in the name of an option, a file or a key with dots."""
    return re.compile(rf"(?<![\w.-]){term}(?:e?s)?(?!\w|[-._\[=]\w)", 0 if term.isupper() else re.IGNORECASE)


def italian(words):
    """Match inflected words: all but the last vowel of each, and any ending; short words, and words with a dot, exactly."""
    def stem(word):
        return word[:-2] if re.search("[cg]i[aeo]$", word) else word[:-1] if len(word) > 3 and word[-1] in "aeiou" else word
    return re.compile("|".join(r"\b" + r"\s+".join(re.escape(stem(word)) + r"\w*" for word in term.split())
                               for term in words.split("/")), re.IGNORECASE)


def forbidden(words):
    """Return words in singular and plural."""
    ends = {"o": "[oi]", "a": "[ae]", "e": "[ei]"}
    return re.compile("|".join(r"\b" + re.escape(word[:-1]) + ends.get(word[-1], re.escape(word[-1])) + r"\b"
                               for word in words.split("/")), re.IGNORECASE)


def messages():
    """Return the English of the program with its Italian, singular and plural separately."""
    done = subprocess.run(["msgattrib", "--no-obsolete", "--no-wrap", ROOT / "src/po/it.po"], capture_output=True, text=True,
                          check=True)
    found = []
    for block in done.stdout.split("\n\n")[1:]:
        texts = {}
        for line in block.splitlines():
            head = re.match(r'(msg\w+(?:\[\d\])?) ', line)
            if head:
                word, line = head[1], line[len(head[0]):]
                texts[word] = ""
            if line.startswith('"'):
                texts[word] += json.loads(line)
        pairs = (("msgid", "msgstr"), ("msgid", "msgstr[0]"), ("msgid_plural", "msgstr[1]"))
        found += [(texts[one], texts[other]) for one, other in pairs if one in texts and other in texts]
    return found


def test_glossary():
    """Each term of src/po/glossary.csv has one Italian word; src/po/glossary-exceptions.csv lists exceptions with reasons"""
    terms = glossary("glossary.csv")
    excepted = {(row["term"], row["message"].replace("\\n", "\n")): row["reason"] for row in glossary("glossary-exceptions.csv")}
    expect(len(terms) >= 60 and all(row["source"] for row in terms) and all(excepted.values()), terms, excepted)
    expect_equal(len({row["english"] for row in terms}), len(terms), "a term twice")
    texts, wrong, needed, used = messages(), [], set(), set()
    expect(len(texts) > 1500, len(texts))
    # A longer term is matched first, and removed before a shorter one: standard deviation, standard.
    spelled = sorted(((one, row) for row in terms for one in row["english"].split("/")), key=lambda pair: -len(pair[0]))
    for source, translation in texts:
        rest = re.sub(r"'[^'\s]*'", "''", source)  # text in quotes is a key or a name
        for term, row in spelled:
            if not english(term).search(rest):
                continue
            rest = english(term).sub("", rest)
            used.add(row["english"])
            never = forbidden(row["forbidden"]).search(translation) if row["forbidden"] else None
            repeated = term not in row["forbidden"].split("/") and english(term).search(translation)  # a word of files
            if never or not (repeated or italian(row["italian"]).search(translation)):
                if (row["english"], source) in excepted:
                    needed.add((row["english"], source))
                else:
                    wrong.append(f"{term}: {row['italian']}, never {row['forbidden']}: {source!r}: {translation!r}")
    expect(not wrong, *wrong)
    expect_equal(set(excepted) - needed, set(), "no exceptions any more")
    expect_equal({row["english"] for row in terms} - used, set(), "terms that no message has")


NEVER = ("uncertainty", "fit", "FAILS", "free run", "growth", "large reserves", "observed", "reserve", "return period", "roughness",
         "standard deviation", "talus", "plausible cases", "yield")  # the words of these have no other use in the manual


def test_manual():
    """ceduo(1), ceduo-terminal(7) and ceduo-workflows(7) are Italian throughout, with the words of the glossary"""
    terms = [row for row in glossary("glossary.csv") if row["english"] in NEVER]
    expect_equal(len(terms), len(NEVER))
    with Folder() as f:
        for page in ("ceduo.1", "ceduo-output.5", "ceduo-terminal.7", "ceduo-workflows.7"):
            least = 90 if page == "ceduo-output.5" else 100  # a sample's output changes more often than words
            made = subprocess.run(["po4a-translate", "-f", "man", "-m", ROOT / "man" / page, "-M", "UTF-8", "-L", "UTF-8", "-k",
                                   str(least), "-p", ROOT / "src/po/man/it.po", "-l", f.path / page], env=environment(),
                                  capture_output=True, text=True, check=False)
            expect((f.path / page).exists(), page, made.stderr)
            text = (f.path / page).read_text(encoding="utf-8")
            found = [f"{page}: {match[0]}" for row in terms for match in forbidden(row["forbidden"]).finditer(text)]
            expect(not found, *found)


def test_data():
    """JSON and CSV are the same bytes in every language"""
    for form in ("json", "csv"):
        for path in sorted((PROFILES / "scenes").glob("*.yaml")):
            expect_equal(*map(without_seconds, run_both("--batch", "-f", form, "-n", 30, path)), f"{path.name}, {form}")
        for words in (("--sensitivity=3", "-n", 20, PAPER), ("--batch", "--years", "0:2", "-n", 20, FOUR),
                      ("--find", "forest[0].stand.stools.per_ha=500:5000", "--goal", "adc=30", PAPER)):
            expect_equal(*map(without_seconds, run_both("-f", form, *words)), f"{words}, {form}")



def test_pages():
    """Pages, help and lists are Italian, at most as wide as in English, with the same numbers"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        uncertainty = () if path == PAPER else ("-s", "uncertainty=none")  # most of the time
        for words in (("--batch", *uncertainty, "-n", 50, path), (*WHOLE, "-n", 50, path), (*WHOLE, "--years", "0:2", "-n", 20, path),
                      ("--batch", *uncertainty, "-n", 20, "-s", "simulation.contact_model=index", path)):
            english, italian = shipped(*words)
            expect_width(italian)
            expect(english != italian and "nplurals" not in italian, italian)
            if words[1] != WHOLE[1]:  # the number of remarks that fit depends on their lengths
                english, italian = (re.split("\n(?:ASSUMED|IPOTESI|NOTE|NOTA|MORE|ALTRO) ", page)[0] for page in (english, italian))
            italian = re.sub(r"(sezione|paragrafo|CRSP) (\d)\.(\d)", r"\1 \2,\3", italian)  # no numbers, but names
            if italian.count("kJ/100 m") != english.count("kJ/100 m"):  # a column that is left out where names are long
                english, italian = (re.sub(r"(?m)^(  .* [✔✘] +[\d.,]+ % +[\d.,]+) +[\d.,]+$", r"\1", page) for page in (english, italian))
            commas = sorted(number.replace(",", ".") for number in re.findall(r"\d+,\d+", italian))
            expect_equal(commas, sorted(re.findall(r"\d+\.\d+", english)), f"numbers of {words}")
            cut = [len(re.findall(r"\w\u2026", text)) for text in (italian, english)]
            expect(cut[0] <= cut[1], f"words cut in {words}", italian)
    for line in good("--help", "--language", "it").out.splitlines():
        expect(len(line) <= 80, line)


def assumed(page):
    """Return the assumptions listed on a page, without their places."""
    below = re.split(r"\n\* (?:Assumed, not measured|Ipotizzato, non misurato):\n", page)[1]
    items = re.findall(r"^  (\S.*(?:\n    \S.*)*)", below, re.M)
    return [re.sub(r" \([^()]*\)$", "", " ".join(item.split())) for item in items]


def test_shipped():
    """Titles and assumptions of all shipped scenes and stands are Italian; JSON keeps them unchanged"""
    with Folder() as f:
        stands = sorted((PROFILES / "stands").glob("*.yaml"))
        every = f.write("every.yaml", "ceduo: scene/1\ntitle: mine\nrock: {diameter_m: 0.5, source: {kind: assumed, text: made up here}}\n"
                        "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\ncontrols_m: [75]\noptions:\n" +
                        "".join(f"  - {{name: {p.stem}, forest: [{{from_m: 0, to_m: 60, stand: {p.stem}}}]}}\n" for p in stands))
        for path in [*sorted((PROFILES / "scenes").glob("*.yaml")), every]:
            english, italian = run_both(*WHOLE, "--years", "0:1", "-n", 1, path)
            mine = {"made up here"} if path == every else set()
            found = [assumed(page) for page in (english, italian)]
            expect_equal(set(found[0]) & set(found[1]), mine, path.name)
            expect(len(found[0]) == len(found[1]) > 0, *found)
            expect_equal(english.splitlines()[0] == italian.splitlines()[0], path == every, path.name)


def test_shipped_title():
    """The report and the page of uncertainty have a shipped title in Italian; JSON keeps it unchanged"""
    titles = "Test site of Ciabocco et al. 2009", "Sito di prova di Ciabocco et al. 2009"
    with Folder() as f:
        good("--report", f.path / "r.html", "-s", "uncertainty=none", "-n", 10, "--language", "it", PAPER)
        report = (f.path / "r.html").read_text(encoding="utf-8")
        expect_in(f"<title>{titles[1]}</title>", report)
        expect_in(f"<h1>{titles[1]}</h1>", report)
    for words, wanted in (((), 1), (("-f", "json"), 0)):
        out = good("--sensitivity=2", "-n", 10, *words, "--language", "it", PAPER).out
        expect_equal([title in out for title in titles], [wanted == 0, wanted == 1], words)


def test_texts_of_files():
    """A file has a text in both languages; a changed text, or one that overrides a base, drops the old Italian one"""
    title = "title: plain\ntitle_it: piano\n"
    source = "source: {kind: assumed, text: guessed, text_it: stimato}"
    with Folder() as f:
        f.write("base.yaml", f"ceduo: stand/1\nname: wood\nname_it: bosco\ntrees: [{{per_ha: 300, dbh_m: 0.3, height_m: 9}}]\n{source}\n")
        f.write("over.yaml", "ceduo: stand/1\nbase: base.yaml\nname: mine\nsource: {text: mine as well}\n")
        scene = (f"ceduo: scene/1\n{title}rock: {{diameter_m: 0.5}}\ncontrols_m: [75]\n"
                 "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
                 "forest: [{from_m: 10, to_m: 60, stand: STAND.yaml}]\n")
        for stand, texts in (("base", ("guessed", "stimato")), ("over", ("mine as well", "mine as well"))):
            path = f.write("s.yaml", scene.replace("STAND", stand))
            for page, head, text in zip(run_both(*WHOLE, "-n", 5, path), ("plain", "piano"), texts):
                expect_equal(page.splitlines()[0], head)
                expect_in(text, page)
            expect(not {"stimato", "guessed"} & set(texts) or stand == "base", texts)
        for page in run_both(*WHOLE, "-n", 5, "-s", "title=other", path):
            expect_equal(page.splitlines()[0], "other")
            expect("guessed" not in page and "stimato" not in page, page)
        italian = run_both(*WHOLE, "-n", 5, "-s", "title=other", "-s", "title_it=altro", path)[1]
        expect_equal(italian.splitlines()[0], "altro")
        expect_equal([json.loads(out)["title"] for out in run_both("--batch", "-f", "json", "-n", 5, path)], ["plain"] * 2)


def test_pictures():
    """Pictures have the same shape in both languages"""
    for what in ("profile", "energy", "height", "histogram", "stand", "compare"):
        english, italian = run_both("--plot", what, "-n", 50, "--option", "coppice with standards", FOUR)
        expect_width(italian)
        expect_equal(len(italian.splitlines()), len(english.splitlines()), what)


def test_ascii():
    """LC_ALL=C: Italian is pure ASCII, without question marks"""
    for words in (("--batch", "-n", 50, PAPER), ("--help",), ("--list-parameters",)):
        text = good(*words, "--language", "it", env={"LC_ALL": "C"}).out
        expect(text.isascii(), "not ASCII", *[line for line in text.splitlines() if not line.isascii()][:4])
        wide = shipped(*words)[1]
        expect_equal(text.count("?"), wide.count("?"), f"question marks of {words}")


if __name__ == "__main__":
    run_all(__name__)
