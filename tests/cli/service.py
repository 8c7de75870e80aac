"""Starts the service for tests and benchmarks, asks it, and waits for what happens."""
import json
import pathlib
import subprocess
import time
import urllib.request


def wait_until(condition, seconds=300, what="something"):
    """The first value of condition() that is true. The deadline is that of a busy machine."""
    end = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise TimeoutError(f"waited in vain for {what}")
        time.sleep(0.02)


class ServiceEnded(Exception):
    """The service ended before it listened; `process` is what is left of it."""

    def __init__(self, process):
        super().__init__(f"the service ended with code {process.returncode} before it listened")
        self.process = process


def start_service(program, data, *options, port=0, **of_process):
    """Starts `throng serve`; returns the process and its port once it listens. of_process goes to subprocess.Popen."""
    data = pathlib.Path(data)
    port_file = data.with_name(data.name + ".port")
    port_file.unlink(missing_ok=True)
    command = [program, "serve", "--data", data, "--port", port, "--port-file", port_file, *options]
    output = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **of_process}
    process = subprocess.Popen([str(word) for word in command], **output)

    def listens():
        return port_file.exists() and port_file.read_text().strip()

    wait_until(lambda: listens() or process.poll() is not None, what="the port of the service")
    if not listens():
        raise ServiceEnded(process)
    return process, int(port_file.read_text())


def send(url, body=None, method=None, key=None, kind="application/json", timeout_s=300):
    """The open answer to a request, whose body is bytes or a JSON value. Raises urllib.error.HTTPError."""
    data = body if body is None or isinstance(body, bytes) else json.dumps(body).encode()
    headers = {"Content-Type": kind, **({"Authorization": f"Bearer {key}"} if key else {})}
    return urllib.request.urlopen(urllib.request.Request(url, data, headers, method=method), timeout=timeout_s)


def ask(url, body=None, **options):
    """The JSON value of the answer; options are those of send()."""
    with send(url, body, **options) as answer:
        return json.loads(answer.read() or b"null")
