#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the akimap developers
"""Lists all that a map file says: its options, then each cell with the bits of its sums.

A reader of its own, which shares nothing with the library: the lists beside the golden files
were made with it, `list_map.py FILE.akimap > FILE.txt`, and the tests hold the library to them.
"""
import gzip
import struct
import sys

KINDS = {"d": 8, "B": 1, "I": 4, "Q": 8, "i": 4}
# Name, kind and the first format that has it, in the order of formats 1 and 2.
INSERTION = [
    ("min_range", "d", 1), ("max_range", "d", 1), ("beyond_max_range", "B", 2),
    ("estimator", "B", 1), ("surface_range", "d", 1), ("free_radius", "d", 1),
    ("max_evidence", "d", 2), ("sampling_distance", "d", 1), ("search_range_origin", "d", 1),
    ("search_range_max", "d", 1), ("search_region", "B", 1), ("covariance_center", "B", 1),
    ("covariance_floor", "d", 1), ("bandwidth", "B", 1), ("isotropic_length", "d", 1),
    ("scale_search", "B", 1), ("scale_min_length", "d", 1), ("scale_max", "d", 1),
    ("prior_alpha", "d", 1), ("prior_beta", "d", 1), ("seed", "Q", 1)]
LIKELIHOOD = [("decimation", "I", 1), ("sigma_hit", "d", 1), ("p_unknown", "d", 1),
              ("p_outlier", "d", 1), ("independent_returns", "d", 1)]
RENDERING = [("threshold", "d", 1), ("show_free", "B", 1), ("max_voxels", "I", 1)]
SWITCHES = ["enableSaveAs3DObject", "enableObservationLikelihood", "enableObservationInsertion"]


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def bytes(self, n):
        if self.at + n > len(self.data):
            sys.exit("the data end early")
        self.at += n
        return self.data[self.at - n:self.at]

    def one(self, kind):
        return struct.unpack("<" + kind, self.bytes(KINDS[kind]))[0]

    def object_head(self, name):
        """MRPT's frame: the name's length + 128, the name, the version."""
        length = self.one("B") & 0x7F
        found = self.bytes(length).decode()
        if found != name:
            sys.exit("it holds a " + found)
        return self.one("B")

    def object_end(self):
        if self.one("B") != 0x88:
            sys.exit("no end flag")


def print_value(name, value):
    print(f"{name} = {value!r}" if isinstance(value, float) else f"{name} = {value}")


def print_block(index, sums):
    for i in range(512):
        alpha, beta = sums[4 * i:4 * i + 4], sums[2048 + 4 * i:2052 + 4 * i]
        if any(alpha) or any(beta):
            cell = [8 * index[0] + i % 8, 8 * index[1] + i // 8 % 8, 8 * index[2] + i // 64]
            print("cell", *cell, alpha[::-1].hex(), beta[::-1].hex())


def checksum(data):
    mask = 0xFFFFFFFF
    lanes = [(i + 1) * 0x9E3779B1 & mask for i in range(32)]
    padded = data + bytes(-len(data) % 128)
    for at, (word,) in enumerate(struct.iter_unpack("<I", padded)):
        h = (lanes[at % 32] ^ word) * 2049 & mask
        lanes[at % 32] = h ^ h >> 15
    total = len(data)
    for h in lanes:
        total = (total ^ h) * 0x9E3779B97F4A7C15 & 0xFFFFFFFFFFFFFFFF
        total ^= total >> 32
    return total


def sections(r):
    """Tags and payloads up to the end."""
    while True:
        header = r.bytes(16)
        if r.one("Q") != checksum(header):
            sys.exit("a damaged header")
        tag, flags, size = struct.unpack("<4sIQ", header)
        payload = r.bytes(size)
        if r.one("Q") != checksum(payload):
            sys.exit(f"a damaged section {tag}")
        if tag == b"END ":
            return
        if flags >> 31 and tag not in (b"HEAD", b"INSO", b"LIKO", b"RENO", b"BLKS", b"CELL"):
            sys.exit(f"unknown required section {tag}")
        yield tag.decode(), payload


# Names of values, in the order of their numbers.
NAMES = {"estimator": ["paper", "surface"], "beyond_max_range": ["ignore", "free"],
         "bandwidth": ["adaptive", "covariance", "isotropic"], "search_region": ["ball", "box"],
         "scale_search": ["exact", "descent"], "covariance_center": ["sample", "mean"],
         "show_free": ["false", "true"]}
KIND_OF = {name: kind for name, kind, _ in INSERTION + LIKELIHOOD + RENDERING}
KIND_OF["resolution"] = "d"


def list_text(prefix, payload):
    for line in payload.decode().splitlines():
        name, value = line.lstrip("!").split(" = ")
        if name in NAMES:
            value = NAMES[name].index(value)
        elif KIND_OF.get(name) == "d":
            value = float(value)
        print_value(prefix + name, value)


def list_3(r):
    prefixes = {"HEAD": "", "INSO": "insertion.", "LIKO": "likelihood.", "RENO": "rendering."}
    blocks = []
    for tag, payload in sections(r):
        if tag in prefixes:
            list_text(prefixes[tag], payload)
        elif tag == "BLKS":
            blocks = list(struct.iter_unpack("<3i", payload))
        elif tag == "CELL":
            for i, index in enumerate(blocks):
                print_block(index, payload[4096 * i:4096 * (i + 1)])


def list_1_or_2(r, version):
    print_value("resolution", r.one("d"))
    if r.object_head("mrpt::maps::TMapGenericParams") != 0:
        sys.exit("unknown generic options")
    for name in SWITCHES:
        print_value(name, r.one("B"))
    r.object_end()
    for prefix, options in ("insertion", INSERTION), ("likelihood", LIKELIHOOD), \
                           ("rendering", RENDERING):
        for name, kind, first in options:
            if first <= version:
                print_value(f"{prefix}.{name}", r.one(kind))
    print_value("scan_index", r.one("Q"))
    for _ in range(r.one("Q")):
        index = [r.one("i") for _ in range(3)]
        print_block(index, r.bytes(4096))


def main():
    r = Reader(gzip.open(sys.argv[1]).read())
    version = r.object_head("akimap::AkiMap")
    print_value("format", version)
    if version not in (1, 2, 3):
        sys.exit(f"unknown format {version}")
    if version == 3:
        list_3(r)
    else:
        list_1_or_2(r, version)
    r.object_end()
    if r.at != len(r.data):
        sys.exit("data behind the map")


main()
