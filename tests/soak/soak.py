#!/usr/bin/env python3
"""Random traffic on a front end of `sanban`, for as long as asked: what GUIs send, in orders they do
not send it in, mixed with noise. Every command must be answered as its protocol says, within
--patience seconds; every process must end by itself with code 0 (or, told to by a signal, as told)
and say nothing on stderr that a sanitizer says. What is behind -- goes to the front end. Meant for a build under sanitizers:

    tests/soak/soak.py build/debug/sanban uci --minutes 20 -- --weights none

The first fault ends it with code 1 and the last lines that were sent.
"""

import argparse
import collections
import queue
import random
import signal
import string
import subprocess
import sys
import tempfile
import threading
import time


class Fault(Exception):
    pass


class Engine:
    """A front end as a process; `lines` has what it says, None at its end."""

    def __init__(self, command, patience):
        self.patience = patience
        self.stderr = tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.stderr)
        self.lines = queue.Queue()
        self.sent = collections.deque(maxlen=40)
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            self.lines.put(line.decode("utf-8", "replace").rstrip("\n"))
        self.lines.put(None)

    def send(self, line):
        data = line if isinstance(line, bytes) else line.encode()
        self.sent.append(data[:300])
        try:
            self.process.stdin.write(data + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            raise Fault("it is gone") from None

    def next_line(self):
        try:
            line = self.lines.get(timeout=self.patience)
        except queue.Empty:
            raise Fault(f"no answer in {self.patience} s") from None
        if line is None:
            raise Fault(f"it ended, code {self.process.wait()}")
        return line

    def end(self, by_signal):
        if by_signal:
            self.process.send_signal(by_signal)
        else:
            self.process.stdin.close()
        try:
            code = self.process.wait(self.patience)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise Fault("it does not end") from None
        allowed = {0} if not by_signal else {0, 128 + by_signal, -by_signal}
        if code not in allowed:
            raise Fault(f"it ended with code {code}")
        self.check_stderr()

    def check_stderr(self):
        self.stderr.seek(0)
        text = self.stderr.read().decode("utf-8", "replace")
        if "Sanitizer" in text or "runtime error" in text:
            raise Fault(text[:4000])


def noise(rng):
    kind = rng.randrange(5)
    if kind == 0:
        return bytes(rng.choice(b"\x00\x01\t \x7f\x80\xc3\xff?=#az09") for _ in range(rng.randrange(40)))
    if kind == 1:
        return "".join(rng.choice(string.printable.replace("\n", "").replace("\r", ""))
                       for _ in range(rng.randrange(80)))
    if kind == 2:
        return rng.choice(string.ascii_letters) * rng.randrange(1, 20000)
    return "  " * rng.randrange(3)


def number(rng):
    return str(rng.choice([0, 1, 2, 5, 10, 50, -1, 10 ** rng.randrange(25), rng.random(), "nan", "1e9", "x", ""]))


class Gtp:
    """Each command carries an id, and exactly one answer comes back with it."""

    analyses = ["lz-analyze", "kata-analyze", "analyze", "kata-search_analyze_cancellable"]
    thinks = ["genmove", "reg_genmove", "kgs-genmove_cleanup", "lz-genmove_analyze",
              "kata-genmove_analyze", "kata-search_analyze"]
    colours = ["b", "w", "black", "white", "B", "x", ""]

    def __init__(self, engine, rng):
        self.engine, self.rng, self.id = engine, rng, 0
        self.commands = self.ask("list_commands").split()
        self.commands = [c for c in self.commands if c not in ("quit", "kata-benchmark")]

    def vertex(self):
        return self.rng.choice(["pass", "resign", "D4", "z9", "", "a0"] + [
            self.rng.choice("ABCDEFGHJKLMNOPQRST") + str(self.rng.randrange(1, 20)) for _ in range(12)])

    def arguments(self, command):
        rng = self.rng
        if command in ("play", "is_legal"):
            return f"{rng.choice(self.colours)} {self.vertex()}"
        if command in self.thinks or command in ("debug_moves", "top_moves", "estimate_score"):
            return rng.choice(self.colours[:4])
        if command in self.analyses:
            return " ".join([rng.choice(self.colours), str(rng.choice([1, 5, 10, 100]))] + rng.sample(
                ["ownership true", "rootInfo true", "minmoves 2", "maxmoves 3", "avoid b D4 3",
                 "allow w E5,pass 1", "movesOwnership true", "pvVisits true", "noresult"], rng.randrange(4)))
        if "boardsize" in command:
            return str(rng.choice([5, 7, 9, 9, 9, 13, 19, 2, 25, 26, 0, -3]))
        if "time" in command and command != "time_left":
            return " ".join(str(rng.choice([0, 1, 2, 5, -1, 10 ** 9])) for _ in range(rng.choice([2, 3, 3, 4])))
        if command == "time_left":
            return f"{rng.choice(self.colours)} {rng.randrange(10)} {rng.randrange(3)}"
        if "handicap" in command:
            return rng.choice(["2", "4", "9", "0", "D4 E5 D4", " ".join(self.vertex() for _ in range(3))])
        if command == "kata-set-rules":
            return rng.choice(["chinese", "japanese", "tromp-taylor", "aga", "new-zealand", "{}", '{"ko":"SIMPLE"}'])
        if command == "kata-set-rule":
            return rng.choice(["ko POSITIONAL", "scoring AREA", "tax ALL", "x y"])
        if command == "loadsgf":
            return rng.choice(["/nonexistent.sgf", "/dev/null", "/", ""])
        if command in ("printsgf", "lz-setoption"):
            return ""
        if command == "gogui-play_sequence":
            return " ".join(f"{rng.choice('bw')} {self.vertex()}" for _ in range(rng.randrange(6)))
        return rng.choice(["", "", number(rng), number(rng), self.vertex(), "alive", "dead", "true false 1 2 3"])

    def ask(self, command):
        self.id += 1
        self.engine.send(f"{self.id} {command}")
        return self.answer()

    def answer(self):
        """Of the command sent last; whatever comes before it is the end of an analysis or of noise."""
        while True:
            head, _, text = self.engine.next_line().partition(" ")
            if head in (f"={self.id}", f"?{self.id}"):
                break
        lines = [text]
        while (line := self.engine.next_line()) != "":
            lines.append(line)
        return "\n".join(lines)

    def step(self):
        rng = self.rng
        if rng.random() < 0.05:
            self.engine.send(noise(rng))
        kind = rng.random()
        if kind < 0.3:
            self.ask(f"play {rng.choice('bw')} {self.vertex()}")
        elif kind < 0.5:
            self.ask(f"genmove {rng.choice('bw')}")
        elif kind < 0.6:
            self.analyse(rng.choice(self.analyses))
        else:
            command = rng.choice(self.commands)
            if command in self.analyses:
                self.analyse(command)
            elif command not in ("stop", "gogui-interrupt"):
                self.ask(f"{command} {self.arguments(command)}")

    # Ends at the next command, whatever that is.
    def analyse(self, command):
        self.id += 1
        self.engine.send(f"{self.id} {command} {self.arguments(command)}")
        time.sleep(self.rng.random() * 0.2)
        self.ask(self.rng.choice(["stop", "name", "komi 7.5", "undo", "showboard"]))


class Uci:
    """Every think that was asked for by a sound line answers once; isready always answers."""

    starts = {
        "uci": ["startpos", "fen r3k2r/p1ppqpb1/bn2pnp1/3PN3/1p2P3/2N2Q1p/PPPBBPPP/R3K2R w KQkq - 0 1",
                "fen 8/8/8/8/8/4k3/4p3/4K3 w - - 0 1", "fen 4k3/8/8/8/8/8/8/4KQ2 w - - 99 80",
                "fen 7k/5Q2/6K1/8/8/8/8/8 b - - 0 1"],
        "usi": ["startpos", "sfen 4k4/9/4P4/9/9/9/9/9/4K4 b 2G2r2b2g4s4n4l17p 1",
                "sfen l6nl/5+P1gk/2np1S3/p1p4Pp/3P2Sp1/1PPb2P1P/P5GS1/R8/LN4bKL w RGgsn5p 1"],
    }
    broken = {
        "uci": ["fen", "fen 9/8/8/8/8/8/8/8 w - - 0 1", "fen kkkkkkkk/8/8/8/8/8/8/8 w KQkq e3 0 1", "startpos moves e2e5"],
        "usi": ["sfen", "sfen 9/9/9/9/9/9/9/9/9 b - 1", "startpos moves 7g7f 7g7f"],
    }

    sound = ["go infinite", "go depth 2"]

    def __init__(self, engine, rng, name):
        self.engine, self.rng, self.name = engine, rng, name
        self.options = []
        engine.send(name)
        while (line := engine.next_line()) != name + "ok":
            if line.startswith("option name "):
                self.options.append(line.removeprefix("option name "))
        self.start, self.moves = "startpos", []
        self.ready()

    def ready(self):
        self.engine.send("isready")
        while self.engine.next_line() != "readyok":
            pass

    def position(self):
        moves = " moves " + " ".join(self.moves) if self.moves else ""
        return f"position {self.start}{moves}"

    def set_option(self):
        option = self.rng.choice(self.options)
        name, kind = option.split(" type ")
        if name in ("Threads", "Hash", "USI_Hash"):
            value = str(self.rng.choice([1, 2, 3, 16, 17, 0, "x"]))
        elif name == "WeightsFile":
            value = self.rng.choice(["/nonexistent", "none", "/dev/null"])
        elif kind.startswith("combo"):
            value = self.rng.choice(kind.split(" var ")[1:] + ["x"])
        elif kind.startswith("check"):
            value = self.rng.choice(["true", "false", "maybe"])
        else:
            value = number(self.rng)
        return f"setoption name {name}" + self.rng.choice([f" value {value}", f" value {value}", ""])

    def limits(self):
        rng = self.rng
        return rng.choice([
            f"nodes {rng.randrange(1, 60)}", f"movetime {rng.randrange(1, 80)}", "infinite",
            f"wtime {rng.randrange(2000)} btime {rng.randrange(2000)} winc 10 binc 10",
            f"btime {rng.randrange(1000)} wtime {rng.randrange(1000)} byoyomi {rng.randrange(200)}",
            "depth 2", "ponder wtime 500 btime 500", f"mate {rng.randrange(1, 4)}", "", "nodes -1", "movetime x",
            "searchmoves e2e4 7g7f nodes 5", "nodes 20 movetime 30"])

    def think(self):
        engine = self.engine
        engine.send(self.position())
        line = "go " + self.limits()
        engine.send(line)
        if self.rng.random() < 0.3:
            time.sleep(self.rng.random() * 0.1)
        if self.rng.random() < 0.1:
            engine.send(self.rng.choice([noise(self.rng), "go nodes 3", self.set_option(), "ponderhit"]))
        engine.send("ponderhit" if "ponder" in line and self.rng.random() < 0.5 else "stop")
        if "ponder" in line:
            engine.send("stop")
        engine.send("isready")
        best = None
        while (text := engine.next_line()) != "readyok":
            if text.startswith(("bestmove", "checkmate")):
                best = text.split()[1]
        self.ready()
        if best is None and line in self.sound:
            raise Fault(f"no move for {line}")
        plain = best and best not in ("resign", "win", "(none)", "0000", "none", "nomate", "timeout", "notimplemented")
        if plain and "mate" not in line:
            self.moves.append(best)
        if not plain or len(self.moves) > 120 or self.rng.random() < 0.02:
            self.moves, self.start = [], self.rng.choice(self.starts[self.name])

    def step(self):
        kind = self.rng.random()
        if kind < 0.6:
            return self.think()
        if kind < 0.8:
            self.engine.send(self.set_option())
        elif kind < 0.85:
            self.engine.send(noise(self.rng))
        elif kind < 0.9:
            self.engine.send("position " + self.rng.choice(self.broken[self.name]))
        else:
            self.engine.send(self.rng.choice([self.name + "newgame", "stop", "ponderhit", "gameover win", self.name, "debug on"]))
        self.ready()


def session(command, protocol, rng, seconds, patience):
    engine = Engine(command, patience)
    steps = 0
    try:
        talk = Gtp(engine, rng) if protocol == "gtp" else Uci(engine, rng, protocol)
        end = time.time() + seconds
        while time.time() < end:
            talk.step()
            steps += 1
        by_quit = rng.random() < 0.5
        if by_quit:
            engine.send("quit")
        engine.end(None if by_quit else rng.choice([None, None, signal.SIGTERM, signal.SIGINT]))
    except Fault as fault:
        engine.process.kill()
        engine.stderr.seek(0)
        print(f"FAULT: {fault}\nlast sent:")
        print("\n".join(repr(line) for line in engine.sent))
        print(engine.stderr.read().decode("utf-8", "replace")[:6000])
        sys.exit(1)
    return steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("executable")
    parser.add_argument("protocol", choices=["gtp", "uci", "usi"])
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--patience", type=float, default=60)
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    options = parser.parse_args(words[:split])
    rng = random.Random(options.seed)
    command = [options.executable, options.protocol, *words[split + 1:]]
    end, steps, processes = time.time() + options.minutes * 60, 0, 0
    while time.time() < end:
        seconds = min(rng.choice([5, 20, 60, 180]), max(0.0, end - time.time()))
        steps += session(command, options.protocol, rng, seconds, options.patience)
        processes += 1
    print(f"{options.protocol}: {steps} exchanges in {processes} processes, no fault")


if __name__ == "__main__":
    main()
