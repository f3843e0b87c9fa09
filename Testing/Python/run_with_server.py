# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Starts a pvserver on a free port, runs a client that connects to it, and waits for both to end.

The exit code is that of the client, or 1 if the server was not well: if it did not start, said an error, or did not
end with its client. 77 where more than one process is asked for and there is no mpirun.

usage: run_with_server.py PVSERVER PROCESSES CLIENT [ARGUMENT...]    PORT in an argument becomes the port
"""
import socket
import subprocess
import sys
import tempfile
import time

from run_parallel import launcher

SECONDS_TO_START, SECONDS_TO_END = 900, 900  # either takes seconds: only what hangs takes longer


def free_port():
    with socket.socket() as some:
        some.bind(("localhost", 0))
        return some.getsockname()[1]


def said(log):
    log.seek(0)
    return log.read()


def wait_for(server, log):
    end = time.monotonic() + SECONDS_TO_START
    while "Accepting connection" not in said(log):
        if server.poll() is not None or time.monotonic() > end:
            raise RuntimeError("The server does not accept connections.")
        time.sleep(0.05)


def main():
    pvserver, processes, *client = sys.argv[1:]
    port = free_port()
    command = [*(launcher(processes) if processes != "1" else []), pvserver, f"--server-port={port}"]
    with tempfile.TemporaryFile("w+", encoding="utf-8") as log:
        server = subprocess.Popen(command, stdout=log, stderr=log)
        try:
            wait_for(server, log)
            code = subprocess.run([a.replace("PORT", str(port)) for a in client], check=False).returncode
            if code == 0:  # else it may never have connected
                server.wait(timeout=SECONDS_TO_END)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            print(error)
            code = 1
        finally:
            if server.poll() is None:
                server.terminate()
                server.wait()
            text = said(log)
            print(text)
    return code or int(server.returncode != 0 or "ERR|" in text or "ERROR:" in text)


if __name__ == "__main__":
    sys.exit(main())
