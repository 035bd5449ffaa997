#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""Trajectories of single rocks in the terminal program, step by step, and the stems they meet."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import WOOD, Place, fast  # noqa: E402
from harness import expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402


def test_rocks_step():
    """. and , step through the trajectories, and so do the arrows in the picture."""
    for scene in ("fast.yaml", "wood.yaml"):
        screens = fast("""wait idle
            key .
            dump
            key .
            dump
            key ,
            dump
            key Tab
            key Right
            dump
            key Left
            dump""", scene)
        for screen, rock in zip(screens, (1, 2, 1, 2, 1)):
            expect(re.match(rf"rock {rock}: .* [\d.]+ m after \d+ contacts", screen.note), screen.note)
            found = re.search(r", (\d+) stems hit$", screen.note)
            expect(bool(found) == (scene == "wood.yaml") and (not found or int(found.group(1)) > 10), screen.note)
        expect_equal(screens[2].note, screens[0].note, "rock 1 again")


def stepped(text, steps, size="100 40", before="key ."):
    """Return view 1 with the picture in front, one trajectory step by step; then view 2."""
    with Place() as place:
        place.write("wood.yaml", text)
        script = f"resize {size}\nwait idle\nkey 1\n{before}\ndump\nkey Tab\n" + "key Down\ndump\n" * steps
        return place.play(script, "wood.yaml")

HIT = re.compile(r"; hits a (shoot|tree) of ([\d.]+) cm: ([\d.]+) of ([\d.]+) kJ")


def test_step_stems():
    """Stepping along a trajectory reports each hit stem, its share of the energy, and the position of a stop."""
    whole, *pieces = stepped(WOOD, 60)
    total = int(re.search(r"(\d+) stems hit", whole.note).group(1))
    count = int(re.match(r"rock 1, segment 1 of (\d+):", pieces[0].note).group(1))
    hits, at = [], None
    for i, screen in enumerate(pieces, 1):
        found = re.match(rf"rock 1, segment {i} of {count}: (flies|rolls) from ([\d.]+) to ([\d.]+) m, ", screen.note)
        expect(found, f"piece {i}:", screen.note)
        expect(at is None or float(found.group(2)) == at, f"piece {i} does not begin where the one before ended", screen.note)
        at = float(found.group(3))
        hit = HIT.search(screen.note)
        if hit:
            hits.append((hit.group(1), float(hit.group(2)), float(hit.group(3)), float(hit.group(4)), at))
    expect(5 < len(hits) <= total, f"{len(hits)} of {total} stems in {len(pieces)} of {count} pieces")
    taken = {("shoot", 6): 1, ("shoot", 12): 5, ("tree", 20): 20, ("tree", 35): 70, ("shoot", 5): 0.5}
    for kind, dbh, takes, has, x in hits:
        expect((kind, dbh) in taken, f"a {kind} of {dbh} cm stands in no belt", hits)
        expect_near(takes, taken[kind, dbh], 0.051 * taken[kind, dbh], f"kJ taken by a {kind} of {dbh} cm")
        expect(has >= takes and 4 <= x <= 81, f"a {kind} of {dbh} cm", hits)
    thick = WOOD.replace("volume_m3: 0.01}", "volume_m3: 9}")
    whole, *pieces = stepped(thick, 40)
    expect(re.match(r"rock 1: is stopped by stems at [\d.]+ m after \d+ contacts, 1 stems? hit", whole.note), whole.note)
    last = [p.note for p in pieces if HIT.search(p.note)]
    expect(last, "the stem that stops the rock", [p.note for p in pieces])
    _, _, takes, has = HIT.search(last[0]).groups()
    expect_equal(takes.rstrip("0").rstrip("."), f"{float(has):.2g}", "it takes all that the rock has")


def test_step_logs():
    """A log on the trajectory is reported with its energy; the index reports no stem."""
    energy = "      energy: {model: brauner"
    logs = "      logs: {per_ha: 300, length_m: 8, diameter_m: 1.5, energy_kJ: 2}\n" + energy
    for model, stems in (("stems", True), ("index", False)):
        scene = WOOD.replace(energy, logs).replace("simulation: {", f"simulation: {{contact_model: {model}, ")
        whole, *pieces = stepped(scene, 40)
        told = [p.note for p in pieces if re.search(r"; hits a log: [\d.]+ of [\d.]+ kJ", p.note)]
        expect_equal(bool(told), stems, model)
        expect_equal("stems hit" in whole.note, stems, whole.note)


def test_step_plan():
    """View 2 shows the stems of the trajectory up to its step; above it or without it a pattern of many."""
    for size in ("100 40", "200 50", "80 50"):
        screens = fast(f"""resize {size}
            wait idle
            key 2
            dump
            key .
            dump
            key 1 Tab
            key Down Down Down
            key 2
            dump
            key 1 Tab
            key {"Down " * 20}
            key 2
            dump
            find forest[1]
            clear
            dump
            key .
            dump""", "wood.yaml")
        _, way, start, more, ahead, lower = screens
        counts = []
        for screen in (way, more, lower):
            found = re.search(r"This trajectory: (\d+) stems? hit in ([\d.]+) m", screen.body)
            expect(found and ("One pattern" in screen.body) == (size == "200 50"), "the rock's way is missing in the", screen)
            counts.append((int(found.group(1)), float(found.group(2))))
        for screen, what in ((start, "before the first stem"), (ahead, "a belt it has not come to")):
            expect("One pattern of many" in screen.body and "The way of" not in screen.body, what, screen)
        expect(counts[0][0] > counts[1][0] > 0 and counts[2][0] > 0, f"stems hit in m: {counts}")
        expect(counts[0][1] == counts[2][1] == 20, f"stems hit in m: {counts}")
        for screen in screens:
            screen.whole()
    expect_in("One pattern of many", fast("resize 100 40\nwait idle\nkey .\nkey 2\ndump", "fast.yaml")[0].body, "by the index")


def test_plan_live():
    """View 2: the plan follows a change of the stand and of the option; no stem of the former forest is shown."""
    with Place() as place:
        edits = "find trees[0]\nset 700\nfind trees[1]\nset 1\nfind shoots[0].per_ha\nset 4000\nwait idle\nclear\ndump"
        before, after = place.play(f"resize 100 44\nwait idle\nkey 1\ndump\nkey 2\nclear\ndump\n{edits}", "wood.yaml")[1:]
        text = (place.path / "wood.yaml").read_text()
        edited = text.replace("per_ha: 80,", "per_ha: 700,").replace("per_ha: 20,", "per_ha: 1,").replace("9000,", "4000,")
        (place.path / "edited.yaml").write_text(edited)
        fresh = place.play("resize 100 44\nwait idle\nkey 1\nkey 2\nclear\ndump", "edited.yaml")[0]
        plans = [re.search(r"\n\n(?=[⠀-⣿]).*This trajectory[^\n]*", screen.body, re.S) for screen in (before, after, fresh)]
        expect(all(plans), "the rock's way is missing in", before, after, fresh)
        expect_equal(plans[1].group(0), plans[2].group(0), "the plan after an edit, and of a scene that was so from the start")
        expect(plans[0].group(0) != plans[1].group(0), "the plan is not changed by the edit")
    thick, thin = fast("resize 100 40\nwait idle\nkey 1\ndump\nkey 2\nclear\ndump\nkey ]\nclear\ndump", "cuts.yaml")[1:]
    expect_in("This trajectory", thick.body)
    words = re.search("This trajectory.*", thick.body).group(0)
    expect(words not in thin.body, "the stems of another option:", thin)


if __name__ == "__main__":
    run_all(__name__)
