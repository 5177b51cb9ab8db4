"""Drag the mouse in a client's window. Compare it with plain VTK's and with a fresh picture.

    drag.py --screen FILE [--unfinished WORD]... COMMAND...

FILE is where Xvfb keeps the screen's pixels (-fbdir). COMMAND starts the client. The client takes
settings (name=value; none: plain VTK) and "camera=position,viewup". It prints a line for each frame
("frame <progress> <mouse's x> <camera>") and for each event of a timer ("timer"). It ends at a line
of input, or obeys a word there: "reparent" or "delete", of its widget. Each check prints a line,
"ok" or "FAIL". The status is 1 if one failed.
"""

import argparse
import contextlib
import functools
import subprocess
import sys
import tempfile
import threading
import time

CASES = {
    "auto": ["technique=auto"],
    "light_radius": ["technique=auto", "light_radius=0.3"],
    "moving_samples": ["technique=penumbra", "light_radius=0.3", "moving_samples=4"],
    "progressive": ["technique=sampled", "light_radius=0.3", "progressive=8"],
}
# This picture takes 300 frames.
SLOW = ["technique=sampled", "light_radius=0.3", "light_samples=300", "progressive=1"]
REFINING = ("moving_samples", "progressive")  # without these, the first frame shows all


class Failed(Exception):
    """Ends the checks of a client that crashed, or that does not do what a check needs."""


class Screen:
    """Xvfb's screen."""

    def __init__(self, path):
        self.path = path
        self.empty = self.picture()

    def picture(self):
        with open(self.path, "rb") as file:
            return file.read()

    def is_empty(self):
        return self.picture() == self.empty


class Client:
    """A running client, with the frames and the number of timer events that it has told."""

    def __init__(self, command):
        self.errors = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.errors,
            text=True,
            bufsize=1,
        )
        self.frames = []  # (progress, the mouse's x, camera)
        self.timers = 0
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            kind, *words = line.split()
            if kind == "frame":
                self.frames.append((float(words[0]), int(words[1]), words[2]))
            else:
                self.timers += 1

    @property
    def progress(self):
        return self.frames[-1][0]

    @property
    def camera(self):
        return self.frames[-1][2]

    def wait_for(self, condition, seconds):
        """Wait for a condition, at most some seconds. Return whether it holds."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return True
            if self.process.poll() is not None:
                raise Failed(f"the client ended with status {self.process.returncode}")
            time.sleep(0.01)
        return False

    def wait(self, seconds):
        self.wait_for(lambda: False, seconds)

    def settle(self):
        """Wait until the client computes nothing for a while, at most three seconds."""
        for _ in range(20):
            before = self._ticks()
            self.wait(0.15)
            if self._ticks() <= before + 1:
                return

    def _ticks(self):
        """Return how long all threads have computed, in hundredths of a second."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            return sum(map(int, file.read().rsplit(")")[1].split()[11:13]))

    def move(self, x, y):
        """Move the mouse, and wait until that is drawn. Return the camera."""
        xdotool("mousemove", x, y)
        if not self.wait_for(lambda: self.frames[-1][1] == x, 20):
            raise Failed("the client draws no frame for a move of the mouse")
        self.settle()
        return self.camera

    def say(self, word):
        self.process.stdin.write(f"{word}\n")

    def end(self):
        """End the client. Return what is wrong: it hangs, fails or has printed to stderr."""
        self.say("end")
        try:
            status = self.process.wait(10)
        except subprocess.TimeoutExpired:
            return "it hangs"
        self.errors.seek(0)
        printed = self.errors.read().strip()
        if printed:
            return f"it printed {printed.splitlines()[0]}"
        return status and f"its status is {status}"


def xdotool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def drag(client):
    """Drag, hold for two seconds, drag on, release, and take the mouse out of the window.

    Returns the camera after each step, and the number of frames while held.
    """
    xdotool("mousemove", 150, 120)
    client.settle()
    xdotool("mousedown", 1)
    client.settle()
    cameras = [client.move(150 + 6 * step, 120 + 3 * step) for step in range(1, 7)]
    before = len(client.frames)
    for _ in range(4):
        client.wait(0.5)
        cameras.append(client.camera)
    held = len(client.frames) - before
    cameras.append(client.move(200, 130))
    xdotool("mouseup", 1, "mousemove", 600, 440)
    return cameras, held


class Checks:
    """The checks of a client, which has the screen for itself."""

    def __init__(self, screen, command):
        self.screen = screen
        self.command = command
        self.failures = 0

    def check(self, name, fault):
        print(f"FAIL {name}: {fault}" if fault else f"ok   {name}", flush=True)
        self.failures += bool(fault)

    def attempt(self, check, name, *arguments):
        try:
            check(name, *arguments)
        except Failed as failed:
            self.check(name, failed)

    @contextlib.contextmanager
    def client(self, *settings):
        """Start a client, and wait for its picture."""
        client = Client([*self.command, *settings])
        try:
            if not client.wait_for(lambda: client.frames and not self.screen.is_empty(), 20):
                raise Failed("the client shows nothing")
            client.settle()
            yield client
        finally:
            xdotool("mouseup", 1)
            client.process.kill()
            client.process.wait()
            while not self.screen.is_empty():
                time.sleep(0.01)

    @functools.cached_property
    def plain(self):
        """Return the cameras of a drag in plain VTK, and the picture after it."""
        with self.client() as client:
            cameras, held = drag(client)
            client.settle()
            return cameras, held, self.screen.picture()

    def check_drag(self, name, settings):
        plain_cameras, plain_held, plain_picture = self.plain
        with self.client(*settings) as client:
            cameras, held = drag(client)
            client.wait(3)
            shown = self.screen.picture()
            frames, timers = len(client.frames), client.timers
            client.wait(0.5)
            frames, timers = len(client.frames) - frames, client.timers - timers
            end = client.end()
        moved = [i for i, (a, b) in enumerate(zip(cameras, plain_cameras)) if a != b]
        self.check(
            f"{name}: the camera is plain VTK's",
            moved and f"not at {moved} of the steps 0 to {len(cameras) - 1}",
        )
        self.check(
            f"{name}: a held drag draws as many frames as plain VTK's",
            held != plain_held and f"{held}, not {plain_held}",
        )
        self.check(f"{name}: shadows show", shown == plain_picture and "none do")
        self.check_picture(name, settings, client, shown)
        self.check(
            f"{name}: it is idle three seconds after the drag",
            (frames or timers) and f"{frames} frames and {timers} timer events in half a second",
        )
        self.check(f"{name}: it ends without a word", end)

    def check_picture(self, name, settings, client, shown):
        """Compare a client's resting picture with the first one of another process."""
        settings = [setting for setting in settings if not setting.startswith(REFINING)]
        with self.client(*settings, f"camera={client.camera}") as another:
            another.wait_for(lambda: self.screen.picture() == shown, 3)
            fresh = self.screen.picture()
        pixels = sum(shown[i : i + 4] != fresh[i : i + 4] for i in range(0, len(fresh), 4))
        self.check(
            f"{name}: the resting picture is a fresh one's",
            pixels and f"{pixels} pixels differ; {client.progress:.0%} of the samples show",
        )

    def check_unfinished(self, word):
        """Say a word to a client whose picture is unfinished."""
        with self.client(*SLOW) as client:
            drag(client)
            client.wait(0.1)
            self.check(f"{word}: the picture is unfinished", client.progress == 1 and "it is not")
            client.say(word)
            client.wait(1)
            if word != "delete":
                client.wait_for(lambda: client.progress == 1, 20)
                client.wait(0.5)
            shown = self.screen.picture()
            end = client.end()
        if word != "delete":
            self.check_picture(word, SLOW, client, shown)
        self.check(f"{word}: it ends without a word", end)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--screen", required=True)
    parser.add_argument("--unfinished", action="append", default=[])
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    checks = Checks(Screen(arguments.screen), arguments.command)
    for name, settings in CASES.items():
        checks.attempt(checks.check_drag, name, settings)
    for word in arguments.unfinished:
        checks.attempt(checks.check_unfinished, word)
    sys.exit(checks.failures > 0)


main()
