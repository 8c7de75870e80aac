"""A Slurm cluster of two nodes on this machine, for tests: munged, slurmctld and two slurmd in a folder of their own,
on ports of their own, without cgroups and accounting. Ends everything it started, whatever happens."""
import contextlib
import ctypes
import os
import pathlib
import pwd
import secrets
import shutil
import signal
import subprocess
import time

from free_ports import free_ports
from service import wait_until

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo", "scontrol")
NODES = ("node1", "node2")


def missing_programs():
    """The programs that this machine lacks. Those of daemons are not in everybody's PATH."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [name for name in PROGRAMS if not shutil.which(name, path=path)]


def prepare_daemon():
    """It ends with its parent, and does not queue for processors behind other work, where the right to that is given."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)
    with contextlib.suppress(OSError):
        os.nice(-10)


class Cluster:
    """`environment` is what programs need to talk to it. A node that does not answer for node_timeout_s is down: on a busy
    machine a healthy one may need many seconds."""

    def __init__(self, base, cpus=1, memory_mib=64000, node_timeout_s=120):
        self.base = pathlib.Path(base)
        self.conf = self.base / "slurm.conf"
        self.environment = dict(
            os.environ,
            SLURM_CONF=str(self.conf),
            THRONG_TEST_CLUSTER=str(self.base),
            PATH=os.environ.get("PATH", "") + ":/usr/sbin:/sbin",
        )
        self.daemons = {}
        for folder in ("state", "munge", "log", *(f"spool-{node}" for node in NODES)):
            (self.base / folder).mkdir(parents=True)
        (self.base / "munge").chmod(0o700)
        key = self.base / "munge" / "key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o600)
        user = pwd.getpwuid(os.getuid()).pw_name
        ports = free_ports(1 + len(NODES))
        lines = [
            "ClusterName=throngtest",
            # Without asking anybody for the name of this host.
            "SlurmctldHost=localhost(127.0.0.1)",
            f"SlurmctldPort={ports[0]}",
            f"SlurmUser={user}",
            f"SlurmdUser={user}",
            f"AuthType=auth/munge\nAuthInfo=socket={self.base}/munge/socket,cred_expire=5",
            f"StateSaveLocation={self.base}/state",
            f"SlurmdSpoolDir={self.base}/spool-%n",
            f"SlurmctldPidFile={self.base}/slurmctld.pid",
            f"SlurmdPidFile={self.base}/%n.pid",
            f"SlurmctldLogFile={self.base}/log/slurmctld.log",
            f"SlurmdLogFile={self.base}/log/%n.log",
            "ProctrackType=proctrack/linuxproc",
            "TaskPlugin=task/none",
            "JobAcctGatherType=jobacct_gather/none",
            "MpiDefault=none",
            "SwitchType=switch/none",
            "SelectType=select/cons_tres",
            "SelectTypeParameters=CR_Core_Memory",
            "SlurmdParameters=config_overrides",
            "MailProg=/bin/true",
            "SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1",
            f"SlurmdTimeout={node_timeout_s}",
            "SlurmctldTimeout=60",
            f"MessageTimeout={min(60, node_timeout_s)}",
            f"BatchStartTimeout={max(60, node_timeout_s)}",
            "KillWait=2",
            "ReturnToService=2",
            "CommunicationParameters=NoCtldInAddrAny",
            "TCPTimeout=5",
        ]
        for node, port in zip(NODES, ports[1:]):
            lines.append(
                f"NodeName={node} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs={cpus} "
                f"RealMemory={memory_mib} State=UNKNOWN"
            )
        lines.append(f"PartitionName=main Nodes={','.join(NODES)} Default=YES MaxTime=INFINITE State=UP")
        self.conf.write_text("\n".join(lines) + "\n")
        (self.base / "cgroup.conf").write_text("")

    def __enter__(self):
        try:
            munge = self.base / "munge"
            self._start(
                "munged",
                "munged",
                "--foreground",
                "--force",
                f"--socket={munge}/socket",
                f"--key-file={munge}/key",
                f"--pid-file={munge}/pid",
                f"--log-file={munge}/log",
                f"--seed-file={munge}/seed",
            )
            wait_until(lambda: (munge / "socket").exists(), what="munged")
            self.start_controller()
            for node in NODES:
                self.start_node(node)
            self.wait_for_nodes()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def _start(self, name, *command):
        log = open(self.base / "log" / f"{name}.out", "ab")
        with log:
            self.daemons[name] = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env=self.environment,
                start_new_session=True,
                preexec_fn=prepare_daemon,
            )

    def start_controller(self):
        self._start("slurmctld", "slurmctld", "-D", "-f", str(self.conf))

    def start_node(self, node):
        self._start(node, "slurmd", "-D", "-N", node, "-f", str(self.conf))

    def end(self, name, number=signal.SIGTERM):
        """A controller that is killed forgets what it did not write down in the last seconds, numbers of jobs included."""
        process = self.daemons.pop(name)
        with contextlib.suppress(ProcessLookupError):
            process.send_signal(number)
        process.wait(120)

    def processes_of(self, node):
        """Processes of the node: its daemon, its steps, and what they started."""
        found = [self.daemons[node].pid] if node in self.daemons else []
        for pid, environment in self._processes():
            if f"SLURMD_NODENAME={node}\0".encode() in environment:
                found.append(pid)
        steps = [pid for pid in found[1:] for pid in (parent_of(pid),) if name_of(pid).startswith("slurmstepd")]
        return found + steps

    def signal_node(self, node, number):
        for pid in self.processes_of(node):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, number)

    def run(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=300, check=False)

    def jobs(self):
        """[(array job, index, state, node)] of all tasks that Slurm remembers."""
        answer = self.run(
            "squeue",
            "--me",
            "--array",
            "--states=all",
            "--noheader",
            "--Format=ArrayJobID:|,ArrayTaskID:|,State:|,NodeList:|",
        )
        return [tuple(line.split("|")[:4]) for line in answer.stdout.splitlines()]

    def node_states(self):
        return self.run("sinfo", "--noheader", "--Node", "--format=%T").stdout.split()

    def wait_for_nodes(self):
        """Until the controller knows all nodes, and none is down."""

        def is_good(state):
            return state in ("idle", "mixed", "allocated", "completing")

        wait_until(lambda: list(map(is_good, self.node_states())) == [True] * len(NODES), what="good nodes")

    def _processes(self):
        """(pid, environment) of everything that runs for this cluster, but for this process."""
        mark = f"THRONG_TEST_CLUSTER={self.base}\0".encode()
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) == os.getpid():
                continue
            with contextlib.suppress(OSError):
                environment = (entry / "environ").read_bytes()
                if mark in environment:
                    yield int(entry.name), environment

    def stop(self):
        for _ in range(50):
            pids = {process.pid for process in self.daemons.values()} | {pid for pid, _ in self._processes()}
            pids |= {parent for pid in pids for parent in (parent_of(pid),) if name_of(parent).startswith("slurmstepd")}
            alive = [pid for pid in pids if is_alive(pid)]
            if not alive:
                break
            for pid in alive:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            for process in self.daemons.values():
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(0.01)
            time.sleep(0.05)
        self.daemons.clear()


def _status(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return ""


def name_of(pid):
    with contextlib.suppress(OSError):
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace")
    return ""


def parent_of(pid):
    fields = _status(pid).rpartition(")")[2].split()
    return int(fields[1]) if len(fields) > 1 else 0


def is_alive(pid):
    fields = _status(pid).rpartition(")")[2].split()
    return bool(fields) and fields[0] != "Z"
