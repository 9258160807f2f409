#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""two_hosts.py LOSS_FILE [--no-multicast] [--mtu BYTES]: two hosts on one machine, and a network between them that
loses packets, and with --no-multicast all that are not for one host.

Each host is a network namespace of its own, so that nothing reaches the other by shared memory or
the loopback device. LOSS_FILE holds the share of packets that is lost, "0" to "1" (a partition), and
is read again five times a second. Prints "ready PID PID": programs are run on a host by
`nsenter --net=/proc/PID/ns/net PROGRAM ...`. Runs until killed, and both hosts with it. Needs root.
"""
import ctypes
import fcntl
import os
import random
import select
import signal
import struct
import subprocess
import sys
import time

TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
CLONE_NEWNET, PR_SET_PDEATHSIG = 0x40000000, 1
MTU = 65535  # unless it is given: a datagram is lost as a whole, not by its pieces
READ_AGAIN_S = 0.2


def start_host():
    """A process in a network namespace of its own, which goes with this one."""
    told, tell = os.pipe()
    pid = os.fork()
    if pid == 0:
        libc = ctypes.CDLL(None, use_errno=True)
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        os.write(tell, b"y" if libc.unshare(CLONE_NEWNET) == 0 else b"n")
        signal.pause()
    if os.read(told, 1) != b"y":
        sys.exit("no network namespace could be made")
    return pid


def on_host(pid, *command):
    subprocess.run(["nsenter", f"--net=/proc/{pid}/ns/net", *command], check=True)


def connect(pid, name, address, mtu):
    """The host's network device; what it sends is read from the returned file."""
    device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", name.encode(), IFF_TUN | IFF_NO_PI))
    subprocess.run(["ip", "link", "set", name, "netns", str(pid)], check=True)
    on_host(pid, "ip", "link", "set", "lo", "up")
    on_host(pid, "ip", "addr", "add", f"{address}/24", "dev", name)
    on_host(pid, "ip", "link", "set", name, "mtu", str(mtu), "multicast", "on", "up")
    on_host(pid, "ip", "route", "add", "224.0.0.0/4", "dev", name)
    return device


def packets_of(device):
    while True:
        try:
            yield os.read(device, MTU)
        except BlockingIOError:
            return


def is_multicast(packet):
    return len(packet) >= 20 and packet[0] >> 4 == 4 and packet[16] >> 4 == 14


def deliver(packet, device):
    try:
        os.write(device, packet)
    except OSError:
        pass  # as a network does


def main():
    random.seed(1)
    hosts = [start_host(), start_host()]
    names = [f"ft{os.getpid()}{side}" for side in "ab"]
    mtu = int(sys.argv[sys.argv.index("--mtu") + 1]) if "--mtu" in sys.argv else MTU
    devices = [connect(pid, names[i], f"198.18.78.{i + 1}", mtu) for i, pid in enumerate(hosts)]
    print("ready", *hosts, flush=True)
    loss, read_s = 0.0, -1e9
    no_multicast = "--no-multicast" in sys.argv
    while True:
        if time.monotonic() - read_s > READ_AGAIN_S:
            read_s = time.monotonic()
            with open(sys.argv[1], encoding="ascii") as file:
                loss = float(file.read() or loss)
        for device in select.select(devices, [], [], READ_AGAIN_S)[0]:
            for packet in packets_of(device):
                if no_multicast and is_multicast(packet):
                    continue
                if random.random() >= loss:
                    deliver(packet, devices[1 - devices.index(device)])


if __name__ == "__main__":
    main()
