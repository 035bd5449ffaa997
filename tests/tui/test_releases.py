#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several releases in view 3: shown, edited and saved; their shares add up to 1."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, check_good  # noqa: E402
from harness import expect_in, run_all  # noqa: E402

RELEASES = """release:
  - {x_m: 0, vx_m_s: 1, share: 0.2}   # kept: the upper face
  - {x_m: 4, vx_m_s: 2, share: 0.3}
  - {x_m: 8, share: 0.5}
"""


def play_and_save(script):
    with Place() as place:
        place.write("fast.yaml", FAST.replace("release: {vx_m_s: 1}\n", RELEASES))
        screens = place.play(f"key 3\n{script}\nkey s\nwait idle\ndump", "fast.yaml")
        check_good(place.path, "fast.yaml")
        return screens, place.text("fast.yaml")


def test_edit():
    """An edited value is saved in its item; nothing else is lost"""
    screens, text = play_and_save("find release[1].x_m\ndump\nset 6")
    expect_in("share", screens[0].text)
    expect_in(RELEASES.replace("x_m: 4", "x_m: 6"), text)


def test_shares():
    """The other shares follow an edited one, in proportion"""
    screens, text = play_and_save("find release[2].share\nset 0.75\ndump")
    expect_in("the other shares follow", screens[0].text)
    for words in ("{x_m: 0, vx_m_s: 1, share: 0.1}   # kept: the upper face", "{x_m: 4, vx_m_s: 2, share: 0.15}", "{x_m: 8, share: 0.75}"):
        expect_in(words, text)


def test_delete():
    """Without a release the others keep their proportion; without the last one rocks start at the first vertex"""
    text = play_and_save("find release[2].share\nkey d")[1]
    expect_in("{x_m: 0, vx_m_s: 1, share: 0.4}", text)
    expect_in("{x_m: 4, vx_m_s: 2, share: 0.6}", text)
    text = play_and_save("find release[2].share\nkey d d d")[1]
    expect_in("stools", text)
    assert "release" not in text, text


if __name__ == "__main__":
    run_all(__name__)
