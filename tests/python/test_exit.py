"""The interpreter exits while other threads are in runs."""

import os
import signal
import subprocess
import sys
import time

import pytest

SCENE = """
import rheonet
scene = rheonet.loads('''
[elements]
m = { type = "mass", at = "a", mass = 2 }
k = { type = "spring", between = ["a", "ground"], stiffness = 200 }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = 1e7
accuracy = 1e-9
method = "ida"
output = { every = 1e6 }
record = ["a.position"]
''')
"""


def start(script):
    return subprocess.Popen([sys.executable, "-c", SCENE + script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize(
    "call",
    [
        "scene.run()",
        "scene.run(threads=2)",
        "scene.run(progress=lambda fraction: None)",
        "scene.run(progress=lambda fraction: time.sleep(0.1))",
        "scene.run(progress=lambda fraction: time.sleep(1e6))",  # waits for what the program no longer does
        "[scene.run(progress=lambda fraction: 1 / 0) for _ in iter(int, 1)]",
        "scene.sweep({'k.stiffness': [100, 200, 300]}, 'max(a.position)')",
        "scene.sensitivities('k.stiffness')",
        "scene.compare(scene)",
    ],
)
def test_a_daemon_thread(call):
    script = f"import threading, time\nthreading.Thread(target=lambda: {call}, daemon=True).start()\ntime.sleep(0.3)\nprint('done')\n"
    process = start(script)
    out, error = process.communicate(timeout=60)
    assert (process.returncode, out) == (0, "done\n"), error
    if "1 / 0" not in call:
        assert error == ""


def test_threads_that_never_stop_calling():
    script = """
import threading, time
text = '[elements]\\ns = { type = "spring", between = ["a", "ground"], stiffness = 1 }\\n'
text += 'x = { type = "motion", at = "a", position = 1 }\\n[simulate]\\nstop = 1\\nrecord = ["s.force"]\\n'
def work():
    while True:
        one = rheonet.loads(text)
        one.run(progress=lambda fraction: None), one.explain(), one._repr_html_()
for _ in range(4):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)
"""
    for _ in range(5):
        process = start(script)
        assert process.communicate(timeout=60) == ("", "") and process.returncode == 0


@pytest.mark.parametrize(
    "script",
    [
        "from concurrent.futures import ThreadPoolExecutor\nwith ThreadPoolExecutor(2) as pool: list(pool.map(lambda _: scene.run(), range(2)))\n",
        "import asyncio\nasync def main(): await asyncio.to_thread(scene.run)\nasyncio.run(main())\n",
    ],
)
def test_interrupts_end_runs_of_a_pool(script):
    process = start("print('ready', flush=True)\n" + script)
    process.stdout.readline()
    for _ in range(30):  # Python itself waits for the threads of a pool several times, and each wait takes one interrupt
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        if process.poll() is not None:
            break
    _, error = process.communicate(timeout=60)
    assert process.returncode in (1, 130, -signal.SIGINT), error
    assert "KeyboardInterrupt" in error and "terminate called" not in error


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")
def test_a_forked_process_does_not_wait_for_threads_of_its_parent():
    script = """
import os, sys, threading, time
threading.Thread(target=scene.run, daemon=True).start()
time.sleep(0.3)
child = os.fork()
if child == 0:
    sys.exit(7)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
    process = start(script)
    assert process.communicate(timeout=60)[0] == "7\n" and process.returncode == 0
