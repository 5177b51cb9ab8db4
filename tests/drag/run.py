"""Drag the mouse over windows with shadows.

    run.py [--most-used] [--all-shadows] [--only TEXT] [--jobs N] KIND COMMAND...

COMMAND starts drag.cxx, drag.py or, for the kind `viewer`, `gnomon`. Each case runs it on an X
server of its own and sends it events by xdotool. A case fails if the program crashes, hangs or
prints an error, if anything moves otherwise than in plain VTK, or if the picture at rest differs
from a new one.

--most-used leaves out the other styles. --all-shadows tries all shadows with every style, not with
one. --only chooses the cases whose names contain TEXT.
"""

import argparse
import contextlib
import json
import os
import select
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

SHADOWS = {
    "auto": [],  # under a light without size
    "area": ["light_radius=0.2"],
    "silhouette": ["technique=silhouette"],
    "moving_samples": ["technique=penumbra", "light_radius=0.2", "moving_samples=4"],
    "progressive": ["technique=sampled", "light_radius=0.2", "progressive=4"],
}
# Styles with modes, and the keys that lead there.
MODES = {"Switch": ["", "t", "a", "ta"], "RubberBandPick": ["", "r"]}
# Where plain VTK 9.1 itself fails.
FAULTS = {
    ("keys", "JoystickActor"): "crash: with key m, OnTimer destroys its timer",
    ("keys", "JoystickCamera"): "the same",
    ("keys", "RubberBandPick"): "key r in a drag: the style keeps the focus",
}
MOST_USED = ["TrackballCamera", "TrackballActor"]

BUTTONS = {1: "left", 2: "middle", 3: "right"}
CONE = (80, 60)  # pixels
AXES = (24, 96)
MOVES = [(5, 2), (10, 6), (14, 11), (10, 15), (4, 12), (7, 5)]  # pixels from where a drag starts
REST = 3.0  # seconds from the release to the finished picture, at most
HANG = 30.0  # seconds, on a busy machine


class Fault(Exception):
    """A fault of a program."""


class Session(contextlib.ExitStack):
    """A program on an X server of its own."""

    def __init__(self, command):
        super().__init__()
        read, write = os.pipe()
        server = self.enter_context(subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "160x120x24", "-noreset",
             "-ardelay", "500", "-arinterval", "150"],  # milliseconds until keys repeat
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        self.callback(server.terminate)
        os.close(write)
        with os.fdopen(read) as pipe:
            display = ":" + pipe.readline().strip()
        # Without threads, as those of Mesa 22.3 may unlock fences that are freed.
        self.environment = dict(os.environ, DISPLAY=display, LP_NUM_THREADS="0")
        self.last_key = ""
        self.errors = self.enter_context(tempfile.TemporaryFile("w+"))
        self.program = self.enter_context(subprocess.Popen(
            command, env=self.environment, stdout=subprocess.PIPE, stderr=self.errors, text=True))
        self.callback(self.program.kill)

    def send(self, *events):
        """Send X events. The program may not have handled them yet."""
        try:
            subprocess.run(
                ["xdotool", *map(str, events)], env=self.environment, check=True, timeout=HANG,
                stdout=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            raise Fault(f"opens no window within {HANG} s: {self.error_text()}") from None

    def ask(self, *events, key=None):
        """Send X events; return what the program says once it has handled them."""
        # Keys repeat on busy machines: a second line has the last key.
        self.last_key = key or ("F11" if self.last_key == "F12" else "F12")
        self.send(*events, "key", "--delay", 0, self.last_key)
        answer = self.read()
        while answer["key"] != self.last_key:
            answer = self.read()
        return answer

    def read(self):
        if not select.select([self.program.stdout], [], [], HANG)[0]:
            raise Fault(f"hangs for {HANG} s: {self.error_text()}")
        line = self.program.stdout.readline()
        if not line:
            self.end()
            raise Fault("ends by itself")
        return json.loads(line)

    def error_text(self):
        self.errors.seek(0)
        return self.errors.read().strip()[-1000:]

    def end(self, expected=""):
        """Wait for the program's end. Only this text may stand among its errors."""
        try:
            status = self.program.wait(timeout=HANG)
        except subprocess.TimeoutExpired:
            raise Fault(f"does not end within {HANG} s") from None
        text = self.error_text()
        if status or (text and not (expected and expected in text)):
            raise Fault(f"ends with status {status}: {text}")


def without_frames(answer):
    return {name: value for name, value in answer.items() if name not in ("frames", "key")}


class Track:
    """Where everything is after each step, beside where plain VTK has it."""

    def __init__(self, session, plain):
        self.session = session
        self.plain = plain  # None while plain VTK itself runs
        self.places = []
        self.moves = []  # by hold: true if something moves on
        self.differences = []  # by rest: pixels
        self.is_exact = True  # false once the run depends on times

    def ask(self, what, *events, key=None):
        try:
            return self.session.ask(*events, key=key)
        except Fault as fault:
            raise Fault(f"{what}: {fault}") from None

    def step(self, what, *events):
        """Send X events, and compare where they lead."""
        places = without_frames(self.ask(what, *events))
        if self.plain and self.is_exact and not any(self.plain.moves):
            for name, expected in self.plain.places[len(self.places)].items():
                if places[name] != expected:
                    raise Fault(f"{what}: {name} {places[name]}, plain VTK's {expected}")
        self.places.append(places)
        return places

    def hold(self, what, seconds, *events):
        """Send X events and wait. Something moves on if and only if it does so in plain VTK."""
        # With each key VTK forgets its last motion, which a creeping camera repeats: send none.
        self.session.send(*events)
        time.sleep(seconds if self.plain else 0.2)
        held = self.step(what)
        expected = self.plain and self.plain.moves[len(self.moves)]
        moves = False
        end = time.monotonic() + (HANG if expected else 0.2)  # a busy machine draws late
        while not moves and time.monotonic() < end:
            time.sleep(0.2)
            moves = self.step(what) != held
        if self.plain and self.is_exact and moves != expected:
            raise Fault(f"{what}: {'moves on' if moves else 'stops'}, unlike in plain VTK")
        self.moves.append(moves)

    def rest(self, what):
        """Wait until no further frame follows, and compare the picture with a new one."""
        first = last = self.ask(what)
        start = quiet = time.monotonic()
        while self.plain and time.monotonic() < min(start + REST, quiet + 0.8):
            time.sleep(0.2)
            state = self.ask(what)
            if state["frames"] != last["frames"]:
                last, quiet = state, time.monotonic()
        if without_frames(last) != without_frames(first):
            raise Fault(f"{what}: moves after the release")
        different = self.ask(what, key="F10")["different"]
        # Plain VTK leaves some rubber bands in the picture.
        if self.plain and different and not self.plain.differences[len(self.differences)]:
            raise Fault(f"{what}: {different} pixels differ from those of a new picture")
        self.differences.append(different)


def to(start, move=(0, 0)):
    return "mousemove", start[0] + move[0], start[1] + move[1]


def drag(track, start):
    """Each button: a slow drag that is held still, and 19 quick ones."""
    for button, name in BUTTONS.items():
        track.step(f"{name} button", *to(start), "key", "F9")
        track.step(f"{name} button pressed", "mousedown", button)
        for move in MOVES[:-1]:
            track.step(f"{name} button moved", *to(start, move))
        track.hold(f"{name} button held", 2, *to(start, MOVES[-1]))
        track.step(f"{name} button released", "mouseup", button)
        track.rest(f"{name} button released")
        track.step(f"{name} button", *to(start))
        for number in range(2, 21):
            what = f"{name} button, drag {number}"
            track.step(what, "mousedown", button, *to(start, MOVES[1]))
            track.step(what, *to(start), "mouseup", button)
        track.rest(f"{name} button, drag 20")


def press(track, start):
    """VTK's keys before drags and in them: pressed, then held until they repeat."""
    for key in "mrfm":
        what = f"key {key}"
        track.step(f"{what} before a drag", *to(start), "key", "--delay", 0, key)
        track.step(f"{what}, drag", "mousedown", 1, *to(start, MOVES[0]))
        track.step(f"{what} in a drag", "key", "--delay", 0, key)
        track.hold(f"{what} in a drag, mouse held", 1, *to(start, MOVES[1]))
        track.step(f"{what} in a drag, released", "mouseup", 1)
        track.rest(what)
    track.is_exact = False  # keys repeat as time allows
    for key in "mrf":
        held = ["keydown", key, "sleep", 0.9, "keyup", key]
        track.step(f"key {key} held", *to(start), *held)
        track.step(f"key {key} held in a drag", "mousedown", 1, *to(start, MOVES[0]), *held)
        track.step(f"key {key} held, released", *to(start, MOVES[1]), "mouseup", 1)
    track.rest("keys held")


class Mode(NamedTuple):
    """A style in a window of drag.cxx or drag.py."""

    style: str
    keys: str
    words: tuple  # of the program's command line

    def __str__(self):
        return " ".join(["+".join(filter(None, [self.style, self.keys])), *self.words])

    def run(self, command, script, words, plain=None):
        """Run a script of events; `plain` is the future Track of plain VTK."""
        start = AXES if "marker" in self.words else CONE
        expected = plain.result() if plain else None
        with Session([*command, self.style, *self.words, *words]) as session:
            session.read()
            track = Track(session, expected)
            track.is_exact = "timer" not in self.words  # styles repeat motions with each timer
            track.step("start", *to(start))
            for key in self.keys:
                track.step(f"key {key}", "key", key)
            script(track, start)
            session.send("key", "q")
            session.end()
            return track

    def run_plain(self, command, script):
        try:
            return self.run(command, script, ["plain"])
        except Fault as fault:
            raise Fault(f"plain VTK: {fault}") from None


def view(command, key):
    """Drag in the viewer, press one of its keys, and drag again."""
    with tempfile.TemporaryDirectory() as folder:
        options = ["--size", "160x120", "-o", f"{folder}/saved"]
        with Session([*command, "view", "soft-stack", *options]) as viewer:
            viewer.send("search", "--sync", "--onlyvisible", "--name", ".")
            for keys in ["type", "--", key], ["key", "q"]:
                viewer.send(*to(CONE), "sleep", 0.5, "mousedown", 1)
                for move in MOVES:
                    viewer.send(*to(CONE, move), "sleep", 0.05)
                viewer.send("sleep", 1.2, "mouseup", 1, "sleep", 0.7, *keys)
                if key == "e":
                    break  # events that find no window are VTK's X errors
            viewer.end(expected="as a wireframe" if key == "w" else "")


def output_of(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def viewer_keys(command):
    """Names of the keys that the viewer documents, and what they type."""
    for line in output_of(*command, "view", "--keys").splitlines():
        if "`" in line:
            name = line.split("`")[1]
            yield name, " " if name == "space" else name


def choose(kind, arguments):
    """Modes of styles, each with one kind of shadows."""
    words = (kind,) if kind in ("timer", "marker") else ()
    few = ["area"] if kind == "keys" else ["auto", "area"]
    for style in output_of(*arguments.command).split():
        if (kind, style) not in FAULTS and (style in MOST_USED or not arguments.most_used):
            is_wide = arguments.all_shadows or style == MOST_USED[0]
            for keys in MODES.get(style, [""]):
                for shadows in SHADOWS if is_wide else few:
                    yield Mode(style, keys, words), shadows


def attempt(name, function, *arguments):
    """Call a function and print how it went."""
    start = time.monotonic()
    says = "right"
    try:
        function(*arguments)
    except Fault as fault:
        says = f"WRONG: {fault}"
    print(f"{name} ({time.monotonic() - start:.0f} s): {says}", flush=True)
    return says == "right"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--most-used", action="store_true")
    parser.add_argument("--all-shadows", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=12)
    parser.add_argument("kind", choices=["styles", "keys", "timer", "marker", "viewer"])
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    kind, command = arguments.kind, arguments.command
    start = time.monotonic()
    with ThreadPoolExecutor(arguments.jobs) as pool:
        if kind == "viewer":
            cases = [(name, view, command, key) for name, key in viewer_keys(command)]
        else:
            script = press if kind == "keys" else drag
            chosen = [case for case in choose(kind, arguments)
                      if arguments.only in "{} {}".format(*case)]
            plain = {mode: pool.submit(mode.run_plain, command, script)
                     for mode in dict.fromkeys(mode for mode, _ in chosen)}
            cases = [(f"{mode} {shadows}", mode.run, command, script, SHADOWS[shadows], plain[mode])
                     for mode, shadows in chosen]
        results = [pool.submit(attempt, *case) for case in cases]
        right = [result.result() for result in results].count(True)
    print(f"{right} of {len(results)} right in {time.monotonic() - start:.0f} s")
    sys.exit(right < len(results))


if __name__ == "__main__":
    main()
