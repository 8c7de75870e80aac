"""A simulated Slurm cluster for tests: a controller in this process, and programs sbatch, squeue, scancel, scontrol and
sacct that talk to it by a socket. Nodes are names; a task that a node runs is a real process of this machine, and only a
few of them run at once, however many nodes there are: the others rest at their beginning.

Time is the controller's own. It goes on with what happens: an end of a task is worth a minute of one node, and while
nothing runs, a look at the queue half a minute.

Every `fault_every`th start of a task has a fault of FAULTS, one kind after the other, at a call of the task's process to the
shared folder that a seed draws (shared_folder.c). A fault that did not come about, since the process had ended, is the
next one's.
"""
import collections
import dataclasses
import itertools
import json
import os
import pathlib
import random
import signal
import socket
import socketserver
import subprocess
import sys
import threading

LOOK_S = 30
TASK_S = 60  # that a task is taken to last
MIN_JOB_AGE_S = 300  # after which a task that has ended is forgotten
NODE_REPAIR_S = 600
REQUEUE_DELAY_S = 120
WORKER_NOT_BEGUN = 75  # jobs/queue/workers/worker_protocol.h
ENDS_WHILE_CUT_OFF = 10  # of other tasks: time enough to give the task to others
CALLS = (40, 160)  # of a simulation, and of a shard of ten frames

# The signal that a process sends itself, and the state that Slurm gives its task. A job that may be requeued begins again under its number where
# the state is in REQUEUED.
FAULTS = {
    "crash": (signal.SIGKILL, "FAILED"),
    "node_fail": (signal.SIGKILL, "NODE_FAIL"),
    "cut_off": (signal.SIGSTOP, "NODE_FAIL"),
    "preempted": (signal.SIGTERM, "PREEMPTED"),
    "timeout": (signal.SIGTERM, "TIMEOUT"),
    "out_of_memory": (signal.SIGKILL, "OUT_OF_MEMORY"),
    "cancelled": (signal.SIGTERM, "CANCELLED"),
    "launch": (None, "LAUNCH_FAILED"),
    "forgotten": (None, None),  # its end is forgotten at once
}
COUNTED = ("crash", "timeout", "out_of_memory", "cancelled")  # as the task's own failures
REQUEUED = ("NODE_FAIL", "PREEMPTED", "LAUNCH_FAILED")
ENDED = ("COMPLETED", "FAILED", "NODE_FAIL", "PREEMPTED", "TIMEOUT", "OUT_OF_MEMORY", "CANCELLED", "LAUNCH_FAILED")
AWAY = "error: Unable to contact slurm controller (connect failure)"


@dataclasses.dataclass
class Task:
    job: int
    index: int
    name: str
    script: str
    folder: str
    environment: dict
    output: str
    nice: int
    may_requeue: bool
    at_once: int
    state: str = "PENDING"
    reason: str = "Resources"
    node: str = ""
    status: int = 0  # as wait() gives it
    restarts: int = 0
    begins_s: float = 0
    ended_s: float = 0
    process: subprocess.Popen = None
    fault: str = ""


class Refusal(Exception):
    pass


def exit_code(status):
    """As squeue prints it by exit_code, and sacct by ExitCode."""
    return f"{status >> 8}:{status & 127}"


class Cluster:
    """`environment` is what programs need to talk to it. `base` is for its own files, `library` shared_folder.c compiled,
    and `shared` the folder that nodes see."""

    def __init__(self, base, library, shared, **options):
        self.base, self.library, self.shared = pathlib.Path(base), library, pathlib.Path(shared)
        self.max_array_size = options.pop("max_array_size", 1001)
        self.fault_every = options.pop("fault_every", 0)
        self.kinds = list(options.pop("faults", FAULTS))
        self.controller_faults = collections.deque(options.pop("controller_faults", ()))
        self.random = random.Random(options.pop("seed", 1))
        self.at_once = options.pop("at_once", 3)
        self.spares = options.pop("spares", lambda task: False)  # tasks that get no fault of COUNTED
        self.process_environment = options.pop("process_environment", {})
        self.has_accounting = options.pop("has_accounting", True)
        self.nodes = {f"node{i:03}": 0.0 for i in range(1, options.pop("nodes", 100) + 1)}  # time of being up again
        assert not options, options
        self.idle = collections.deque(self.nodes)
        self.now_s = 0.0
        self.tasks = {}
        self.forgotten = {}
        self.next_job = 1
        self.starts = 0
        self.hasty_restarts = 0
        self.refused_starts = 0  # of workers without the right to begin
        self.faults = collections.Counter()
        self.dealt = itertools.cycle(self.kinds)
        self.delays = itertools.cycle((REQUEUE_DELAY_S, 0))
        self.postponed = collections.deque()
        self.calls = collections.Counter()
        self.away = 0  # calls that get no answer
        self.queue = collections.deque()  # tasks whose node has them, without a process yet
        self.processes = 0
        self.frozen = []  # (ends before, process): of nodes that were cut off
        self.changed = threading.Condition(threading.RLock())
        self.ends = 0
        self.threads = []
        self.is_stopping = False
        self._install()

    def _install(self):
        (self.base / "bin").mkdir(parents=True)
        (self.base / "counts").mkdir()
        path = self.base / "socket"
        for name in ("sbatch", "squeue", "scancel", "scontrol", "sacct"):
            program = self.base / "bin" / name
            program.write_text(f'#!/bin/sh\nLD_PRELOAD= exec {sys.executable} -ISs {__file__} {path} {name} "$@"\n')
            program.chmod(0o755)
        self.environment = dict(os.environ, PATH=f"{self.base}/bin:{os.environ['PATH']}")
        cluster = self

        class Handler(socketserver.StreamRequestHandler):
            def handle(self):
                request = json.loads(self.rfile.readline())
                code, text = cluster.answer(request["words"], request["environment"])
                self.wfile.write(json.dumps([code, text]).encode())

        self.server = socketserver.ThreadingUnixStreamServer(str(path), Handler)
        self.server.daemon_threads = True
        threading.Thread(target=self.server.serve_forever, args=(0.05,), daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with self.changed:
            self.is_stopping = True
            processes = [task.process for task in self.tasks.values()] + [process for _, process in self.frozen]
            for process in processes:
                if process and process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
        for thread in self.threads:
            thread.join()
        self.server.shutdown()
        self.server.server_close()

    # Programs.

    def answer(self, words, environment):
        """(exit code, output) of a program of Slurm."""
        with self.changed:
            self.calls[words[0]] += 1
            if self.away == 0 and self.controller_faults and self.controller_faults[0][0] <= self.ends:
                self._begin_controller_fault(words[0])
            if self.away > 0:
                self.away -= 1
                return 1, f"{words[0]}: {AWAY}\n"
            try:
                return 0, getattr(self, "_" + words[0])(words[1:], environment)
            except Refusal as refusal:
                return 1, f"{words[0]}: {refusal}\n"

    def _begin_controller_fault(self, program):
        """(ends of tasks before it, "away", calls) or (ends, "lost_answer", None) or (ends, "slow", None)"""
        _, kind, amount = self.controller_faults[0]
        if program != {"away": program, "lost_answer": "sbatch", "slow": "squeue"}[kind]:
            return
        self.controller_faults.popleft()
        self.faults[kind] += 1
        if kind == "away":
            self.away = amount
        else:
            setattr(self, "is_" + kind, True)

    is_lost_answer = False
    is_slow = False

    def _sbatch(self, words, environment):
        options = {"nice": "0", "array": "0", "output": "/dev/null"}
        may_requeue = True
        for word in words:
            name, _, value = word.removeprefix("--").partition("=")
            may_requeue = {"requeue": True, "no-requeue": False}.get(name, may_requeue)
            options[name] = value
        if "test-only" in options:
            return ""
        indices, _, at_once = options["array"].partition("%")
        last = int(indices.split("-")[-1])
        if last >= self.max_array_size:
            raise Refusal("error: Batch job submission failed: Invalid job array specification")
        job = self.next_job
        self.next_job += last + 1
        for index in range(last + 1):
            self.tasks[job, index] = Task(
                job=job,
                index=index,
                name=options["job-name"],
                script=options["wrap"],
                folder=options["chdir"],
                environment=environment,
                output=options["output"].replace("%a", str(index)),
                nice=int(options["nice"]),
                may_requeue=may_requeue,
                at_once=int(at_once or 0),
                begins_s=self.now_s,
            )
        self._schedule()
        if self.is_lost_answer:
            self.is_lost_answer = False
            raise Refusal("error: Batch job submission failed: Socket timed out on send/recv operation")
        return f"{job}\n"

    def _squeue(self, words, _):
        assert {"--me", "--array", "--states=all", "--noheader"} < set(words), words
        form = next(word for word in words if word.startswith("--Format=")).removeprefix("--Format=")
        fields = [field.partition(":") for field in form.split(",")]
        text = "".join(
            "".join(self._field(task, name.lower()) + suffix for name, _, suffix in fields) + "\n"
            for task in self.tasks.values()
        )
        if self.processes == 0:
            self.now_s += LOOK_S
        self._schedule()
        if self.is_slow:
            # The answer arrives when it is no longer true.
            self.is_slow = False
            before = self.ends
            while self.processes > 0 and self.ends < before + 3:
                self.changed.wait()
        return text

    def _field(self, task, name):
        return {
            "arrayjobid": str(task.job),
            "arraytaskid": str(task.index),
            "state": task.state,
            "nodelist": task.node,
            "reason": task.reason,
            "exit_code": str(task.status),
            "name": task.name,
        }[name]

    def _chosen(self, words):
        """Tasks of "--name=NAME JOB JOB_INDEX ..."."""
        name = next((word.removeprefix("--name=") for word in words if word.startswith("--name=")), None)
        ids = {word for word in words if not word.startswith("--")}
        for task in list(self.tasks.values()):
            if name is not None and task.name != name:
                continue
            if not ids or str(task.job) in ids or f"{task.job}_{task.index}" in ids:
                yield task

    def _scancel(self, words, _):
        for task in self._chosen(words):
            if task.state in ENDED:
                continue
            if task.process is not None:
                task.fault = task.fault or "scancel"
                self._signal(task.process, signal.SIGTERM)
            else:
                if task in self.queue:
                    self.queue.remove(task)
                self._end(task, "CANCELLED", 0)
        return ""

    def _scontrol(self, words, _):
        job, nice = words[1].removeprefix("JobId="), words[2].removeprefix("Nice=")
        for task in self._chosen([job]):
            task.nice = int(nice)
        return ""

    def _sacct(self, words, _):
        if not self.has_accounting:
            raise Refusal("error: Slurm accounting storage is disabled")
        ids = set(words[words.index("-j") + 1].split(","))
        fields = words[words.index("-o") + 1].split(",")
        known = [*self.forgotten.values(), *self.tasks.values()]
        chosen = [task for task in known if str(task.job) in ids or f"{task.job}_{task.index}" in ids]
        return "".join("|".join(self._account(task, field) for field in fields) + "\n" for task in chosen)

    def _account(self, task, field):
        return {
            "JobID": f"{task.job}_{task.index}",
            "State": task.state,
            "ExitCode": exit_code(task.status),
            "NodeList": task.node,
            "JobName": task.name,
        }[field]

    # Time.

    def _schedule(self):
        if self.is_stopping:
            return
        for key, task in list(self.tasks.items()):
            if task.state in ENDED and self.now_s > task.ended_s + MIN_JOB_AGE_S:
                self.forgotten[key] = self.tasks.pop(key)
        for node, up_s in self.nodes.items():
            if 0 < up_s <= self.now_s:
                self.nodes[node] = 0
                self.idle.append(node)
        running = collections.Counter(task.job for task in self.tasks.values() if task.state == "RUNNING")
        waiting = [task for task in self.tasks.values() if task.state == "PENDING"]
        for task in sorted(waiting, key=lambda task: (task.nice, task.job, task.index)):
            if not self.idle:
                break
            if "held" in task.reason or task.begins_s > self.now_s:
                continue
            if task.at_once and running[task.job] >= task.at_once:
                task.reason = "JobArrayTaskLimit"
                continue
            running[task.job] += 1
            self._give_node(task)
        self._start_processes()

    def _give_node(self, task):
        task.node = self.idle.popleft()
        task.state, task.reason = "RUNNING", "None"
        self.starts += 1
        if self.fault_every and self.starts % self.fault_every == 0:
            task.fault = self.postponed.popleft() if self.postponed else next(self.dealt)
            if task.fault in COUNTED and self.spares(task):
                self.postponed.append(task.fault)
                task.fault = ""
        self.queue.append(task)

    def _start_processes(self):
        while self.processes < self.at_once and self.queue:
            task = self.queue.popleft()
            if task.fault == "launch":
                self.faults[task.fault] += 1
                self._end(task, "LAUNCH_FAILED", 0)
                continue
            self.processes += 1
            thread = threading.Thread(target=self._run, args=(task,), daemon=True)
            self.threads.append(thread)
            thread.start()

    # Nodes.

    def _environment_of(self, task, counts):
        environment = dict(
            task.environment,
            **self.process_environment,
            SLURM_ARRAY_JOB_ID=str(task.job),
            SLURM_ARRAY_TASK_ID=str(task.index),
            SLURMD_NODENAME=task.node,
            LD_PRELOAD=str(self.library),
            SHARED_ROOT=str(self.shared),
            SHARED_COUNTS=str(counts),
        )
        environment.pop("SHARED_FAULT", None)
        number = FAULTS[task.fault][0] if task.fault in FAULTS else None
        if number is not None:
            environment["SHARED_FAULT"] = f"{int(number)} {self.random.randint(1, self.random.choice(CALLS))}"
        return environment

    def _run(self, task):
        """A task on its node, from its beginning to its end."""
        with self.changed:
            node = task.node
            counts = self.base / "counts" / f"{task.job}_{task.index}_{task.restarts}"
            environment = self._environment_of(task, counts)
        try:
            output = open(task.output, "ab")
        except FileNotFoundError:  # its folder went with the array
            output = open(os.devnull, "ab")
        with output:
            process = subprocess.Popen(
                ["/bin/sh", "-c", task.script],
                cwd=task.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                start_new_session=True,
            )
        with self.changed:
            task.process = process
        # Popen itself sees no stop.
        is_stopped = os.waitid(os.P_PID, process.pid, os.WEXITED | os.WSTOPPED | os.WNOWAIT).si_code == os.CLD_STOPPED
        status = 0
        if not is_stopped:
            code = process.wait()
            status = -code if code < 0 else code << 8
        with self.changed:
            self.processes -= 1
            self.refused_starts += status == WORKER_NOT_BEGUN << 8
            if is_stopped:
                self.frozen.append((self.ends, process))
            self._note_end(task, node, status, is_stopped)
            self._schedule()
            self.changed.notify_all()
        self.thaw(lambda since: self.ends > since + ENDS_WHILE_CUT_OFF)

    def _note_end(self, task, node, status, is_stopped):
        task.process = None
        fault, task.fault = task.fault, ""
        number, state = FAULTS.get(fault, (None, None))
        has_come = number is not None and (is_stopped or status == number)
        if fault == "forgotten":
            self.faults[fault] += 1
            self._end(task, "COMPLETED" if status == 0 else "FAILED", status)
            if (task.job, task.index) in self.tasks:
                self.forgotten[task.job, task.index] = self.tasks.pop((task.job, task.index))
        elif has_come:
            self.faults[fault] += 1
            self._end(task, state, status)
        else:
            if number is not None:
                self.postponed.append(fault)
            is_cancelled = fault == "scancel" and status != 0
            self._end(task, "CANCELLED" if is_cancelled else "COMPLETED" if status == 0 else "FAILED", status)

    def _end(self, task, state, status):
        """Of the task on its node, or before it had one."""
        self.ends += 1
        self.now_s += TASK_S / len(self.nodes)
        if task.node:
            if state == "NODE_FAIL":
                self.nodes[task.node] = self.now_s + NODE_REPAIR_S
            else:
                self.idle.append(task.node)
        if state in REQUEUED and task.may_requeue:
            task.state, task.node, task.status = "PENDING", "", 0
            task.restarts += 1
            task.reason = "launch failed requeued held" if state == "LAUNCH_FAILED" else "BeginTime"
            # Slurm's controller waits, so that the server sees it; an administrator's requeue does not.
            delay_s = next(self.delays)
            self.hasty_restarts += delay_s == 0
            task.begins_s = self.now_s + delay_s
            return
        task.state, task.status, task.ended_s = state, status, self.now_s
        task.reason = {"FAILED": "NonZeroExitCode", "NODE_FAIL": "NodeDown"}.get(state, "None")

    @staticmethod
    def _signal(process, number):
        if process.poll() is None:
            os.killpg(process.pid, number)

    def thaw(self, is_due=lambda since: True):
        """Lets processes of nodes that were cut off go on, and waits for their ends; `since` are the ends before."""
        with self.changed:
            due = [entry for entry in self.frozen if is_due(entry[0])]
            self.frozen = [entry for entry in self.frozen if entry not in due]
        for _, process in due:
            self._signal(process, signal.SIGCONT)
        for _, process in due:
            process.wait()


def main(path, *words):
    """One of Slurm's programs."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
        connection.connect(path)
        request = {"words": words, "environment": dict(os.environ) if words[0] == "sbatch" else {}}
        connection.sendall(json.dumps(request).encode() + b"\n")
        code, text = json.loads(connection.makefile().read())
    print(text, end="", file=sys.stderr if code else sys.stdout)
    sys.exit(code)


if __name__ == "__main__":
    main(*sys.argv[1:])
