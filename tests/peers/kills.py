#!/usr/bin/env python3
"""The editor's window, killed while it saves a GLB or exports an OBJ with its material and image.

usage: kills.py EDITOR [--kills N] [--seed S] [--display :79]

EDITOR is the program trigon-editor. Needs Xvfb and xdotool. In each round the window opens a document, vertices are moved by
keys, the document is saved or exported, and SIGKILL comes at a random moment from the key on. Then:

- the file is the old or the new one to the byte, and so are the three files of an export once the model was opened;
- the editor, started again, offers what was not saved; what it then saves has the bytes that `--run` writes for the
  commands of the recovery file, and these are at least the commands that the window had run before the save began.

Exit code 1 if anything else was found. The folder with what was found stays.
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

# Enough that a save takes a while.
SEGMENTS = 300
KEYMAP = {"file.export": "F9"}
DEADLINE = 60.0
# What is beside a model when no save is under way; a save that was cut short leaves other files.
FINISHED = (".glb", ".obj", ".mtl", ".png", ".bak", ".json", "")


def await_that(what, is_done, deadline=DEADLINE):
    end = time.monotonic() + deadline
    while not is_done():
        if time.monotonic() > end:
            raise RuntimeError(f"{what}: not after {deadline} s")
        time.sleep(0.01)


def image(color):
    """A PNG of 16 × 16 pixels of one colour."""
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = (b"\0" + bytes(color) * 16) * 16
    header = struct.pack(">IIBBBBB", 16, 16, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Records:
    """A recovery file, read without trigon: eight bytes, then records with length and checksum."""

    def __init__(self, bytes_):
        self.payloads, at = [], 8
        while at + 16 <= len(bytes_):
            (length,) = struct.unpack_from("<Q", bytes_, at)
            if at + 16 + length > len(bytes_):
                break
            self.payloads.append(bytes_[at + 16 : at + 16 + length])
            at += 16 + length
        self.base = self.payloads[0] if self.payloads else None
        self.events = [json.loads(payload) for payload in self.payloads[1:]]


class Rounds:
    def __init__(self, editor, folder, display, seed):
        self.editor, self.folder, self.random = str(editor), folder, random.Random(seed)
        self.state = folder / "state/trigon/recovery"
        self.environment = {
            **os.environ,
            "HOME": str(folder),
            "XDG_CONFIG_HOME": str(folder / "config"),
            "XDG_STATE_HOME": str(folder / "state"),
            "DISPLAY": display,
        }
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.process = None
        kinds = [f"{kind} {ending}" for ending in ("glb", "obj") for kind in ("old", "new", "cut short")]
        self.tally = dict.fromkeys([*kinds, "recovered", "nothing to recover"], 0)

    # Scripts without a window.

    def run(self, commands, source, target):
        script = self.folder / "script.json"
        script.write_text(json.dumps(commands), encoding="ascii")
        words = [self.editor, "--quiet", "--run", script, *([source] if source else []), "--output", target]
        subprocess.run([str(word) for word in words], check=True, env=self.environment)

    def make_documents(self):
        """Two documents that differ in their mesh, their material and their image."""
        self.documents = []
        for number, color in enumerate([(200, 30, 30), (20, 60, 220)]):
            # The same name, so that both exports replace each other's image.
            picture = self.folder / f"pictures{number}/picture.png"
            picture.parent.mkdir()
            picture.write_bytes(image(color))
            document = self.folder / f"document{number}.glb"
            commands = [
                {
                    "op": "add_object",
                    "object": {"shape": "uv_sphere", "radius": 1.0 + number, "segments": SEGMENTS, "rings": SEGMENTS // 2},
                },
                {"op": "add_material", "name": f"paint {number}"},
                {"op": "assign_texture", "texture": {"from": "file", "path": str(picture)}},
            ]
            self.run(commands, None, document)
            self.documents.append(document)
        self.run([], self.documents[-1], self.folder / "out/model.obj")

    # The window.

    def start(self, *arguments):
        words = [self.editor, *(str(argument) for argument in arguments)]
        self.process = subprocess.Popen(words, env=self.environment, cwd=self.folder, stderr=subprocess.DEVNULL)
        search = ["xdotool", "search", "--sync", "--onlyvisible", "--pid", str(self.process.pid)]
        found = subprocess.run(search, env=self.environment, capture_output=True, text=True, timeout=DEADLINE, check=True)
        self.window = found.stdout.split()[0]
        self.do("windowfocus", "--sync", self.window)
        self.do("mousemove", "600", "400")
        await_that("a recovery file", lambda: self.records() is not None)

    def do(self, *words):
        subprocess.run(["xdotool", *words], env=self.environment, check=True, timeout=DEADLINE)

    def keys(self, *names):
        self.do("key", "--delay", "25", *names)

    def press_until(self, key, what, is_done):
        """A key that comes before the window is ready for it is pressed again."""
        end = time.monotonic() + DEADLINE
        while not is_done():
            if time.monotonic() > end:
                raise RuntimeError(f"{what}: not after {DEADLINE} s")
            self.keys(key)
            wait = time.monotonic() + 2.0
            while not is_done() and time.monotonic() < wait:
                time.sleep(0.02)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def records(self):
        """The newest recovery file, once its base is whole."""
        files = sorted(self.state.glob("*.recovery"), key=lambda path: path.stat().st_mtime_ns)
        records = Records(files[-1].read_bytes()) if files else None
        return records if records and records.base is not None else None

    def move(self, number):
        """Moves everything by keys; returns when the recovery file holds it."""
        count = len(self.records().events)
        self.keys("a", "g", "xyz"[number % 3], *str(self.random.randrange(1, 9)), "Return")
        is_there = lambda: any("translate" in json.dumps(event) for event in self.records().events[count:])
        await_that("a move in the recovery file", is_there)

    def commands(self, records):
        assert all("Run" in event or "run" in event for event in records.events), records.events
        return [next(iter(event.values())) for event in records.events]

    def expected(self, records, count, name):
        """The bytes that a script without a window writes for the first commands."""
        base, target = self.folder / "base.glb", self.folder / name
        base.write_bytes(records.base)
        self.run(self.commands(records)[:count], base, target)
        return self.set_of(target)

    # A round.

    def set_of(self, model):
        paths = [model]
        if model.suffix == ".obj":
            paths += [model.with_suffix(".mtl"), model.parent / f"{model.stem}_picture.png"]
        return {path.suffix: path.read_bytes() for path in paths}

    def round(self, number):
        shutil.rmtree(self.state, ignore_errors=True)
        document = self.documents[number // 4 % 2]
        model = document if number % 2 == 0 else self.folder / "out/model.obj"
        for path in self.unfinished(model.parent):
            (model.parent / path).unlink()
        old = self.set_of(model)
        self.start(document)
        for step in range(self.random.randrange(1, 4)):
            self.move(number + step)
        done = len(self.records().events)
        if model.suffix == ".obj":
            # Nothing outside tells that the dialog is there.
            self.keys("F9")
            time.sleep(1.0)
            self.keys("ctrl+a")
            self.do("type", "--delay", "5", str(model))
            time.sleep(0.5)
        key = "Return" if model.suffix == ".obj" else "ctrl+s"
        presser = subprocess.Popen(["xdotool", "key", key], env=self.environment)
        self.await_moment(model.parent, number)
        self.kill()
        presser.wait()
        records = self.records()
        assert len(records.events) >= done, "commands that were recorded are there"
        self.check_files(model, old, records)
        self.check_recovery(document, records)

    def await_moment(self, folder, number):
        """Every second round of a kind ends at any time after the key, the others soon after the save began to write."""
        if number // 2 % 2:
            end = time.monotonic() + DEADLINE / 10
            while time.monotonic() < end and not self.unfinished(folder):
                pass
            time.sleep(self.random.random() * self.longest / 10)
        else:
            # Writing the text of an OBJ takes longer.
            time.sleep(self.random.random() * self.longest * (1 + 4 * (number % 2)))

    def unfinished(self, folder):
        return [name for name in os.listdir(folder) if pathlib.PurePath(name).suffix not in FINISHED]

    def check_files(self, model, old, records):
        left = self.unfinished(model.parent)
        ending = model.suffix[1:]
        self.tally[f"cut short {ending}"] += bool(left)
        if model.suffix == ".obj":
            # Opening the model completes what was begun.
            self.run([], model, self.folder / "opened.glb")
        found = self.set_of(model)
        if found == old:
            self.tally[f"old {ending}"] += 1
            return
        new = self.expected(records, len(records.events), f"expected/model{model.suffix}")
        what = {ending: found.get(ending) == new.get(ending) for ending in new}
        assert found == new, f"neither old nor new: {what}, left {left}"
        self.tally[f"new {ending}"] += 1

    def check_recovery(self, document, records):
        """The document comes back as the last command left it."""
        [expected] = self.expected(records, len(records.events), "expected/document.glb").values()
        if document.read_bytes() == expected:
            self.tally["nothing to recover"] += 1
            return
        before = document.read_bytes()
        [left] = self.state.glob("*.recovery")
        self.start()
        self.press_until("Return", "the recovered document", lambda: not left.exists())
        self.press_until("ctrl+s", "the recovered document in its file", lambda: document.read_bytes() != before)
        self.kill()
        assert document.read_bytes() == expected, "the recovered document is another one"
        self.tally["recovered"] += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("editor", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--longest", type=float, default=0.25, help="seconds from the key to the kill at most")
    parser.add_argument("--display", default=":79")
    arguments = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="trigon-window-kills-"))
    for name in ("out", "expected", "config/trigon"):
        (folder / name).mkdir(parents=True)
    rounds = Rounds(arguments.editor.resolve(), folder, arguments.display, arguments.seed)
    rounds.longest = arguments.longest
    (folder / "config/trigon/editor-keymap.json").write_text(json.dumps(KEYMAP), encoding="ascii")
    screen = subprocess.Popen(["Xvfb", arguments.display, "-screen", "0", "1400x900x24", "-noreset"], stderr=subprocess.DEVNULL)
    try:
        time.sleep(1)
        rounds.make_documents()
        for number in range(arguments.kills):
            rounds.round(number)
            if number % 10 == 9 or number + 1 == arguments.kills:
                print(f"{number + 1} kills: {rounds.tally}", flush=True)
    finally:
        if rounds.process and rounds.process.poll() is None:
            rounds.kill()
        screen.terminate()
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
