#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""keystore.py FOLDER: identities of DDS-Security for the tests, laid out as SROS2 does.

Makes FOLDER/enclaves/NAME for: vehicle and operator (may write and read all), viewer (may read all,
and write what a participant says of itself), expired (as vehicle, but its certificate is over) and
stranger (of another authority). All messages are signed, discovery and samples encrypted.
Needs the program openssl.
"""
import subprocess
import sys
from pathlib import Path

OPENSSL = "openssl"
FOR_EVER = "<validity><not_before>2020-01-01T00:00:00</not_before>" \
           "<not_after>2100-01-01T00:00:00</not_after></validity>"
DOMAINS = "<domains><id_range><min>0</min><max>232</max></id_range></domains>"
GOVERNANCE = f"""<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><domain_access_rules><domain_rule>
{DOMAINS}
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>SIGN</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT</metadata_protection_kind>
<data_protection_kind>NONE</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
"""


def run(*words):
    subprocess.run([OPENSSL, *map(str, words)], check=True, capture_output=True)


def authority(folder, name):
    """A key and a certificate that signs itself."""
    folder.mkdir(parents=True, exist_ok=True)
    run("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
        "-keyout", folder / f"{name}.key.pem", "-out", folder / f"{name}.cert.pem", "-days", "3650",
        "-subj", f"/O=foretrack tests/CN={name}", "-addext",
        "keyUsage=critical,keyCertSign,cRLSign,digitalSignature")


def signed(folder, name, text, private, authority_name):
    plain = folder / (name + ".xml")
    plain.write_text(text)
    run("smime", "-sign", "-text", "-in", plain, "-out", folder / (name + ".p7s"), "-signer",
        private / f"{authority_name}.cert.pem", "-inkey", private / f"{authority_name}.key.pem")


def permissions(name, writes):
    topics = "".join(f"<topic>{topic}</topic>" for topic in writes)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><permissions><grant name="{name}">
<subject_name>CN={name},O=foretrack tests</subject_name>{FOR_EVER}
<allow_rule>{DOMAINS}<publish><topics>{topics}</topics></publish>
<subscribe><topics><topic>*</topic></topics></subscribe></allow_rule>
<default>DENY</default></grant></permissions></dds>
"""


def enclave(store, name, writes, identity_authority="identity_ca", days=365):
    private, folder = store / "private", store / "enclaves" / name
    folder.mkdir(parents=True, exist_ok=True)
    request = folder / "request.pem"
    run("req", "-new", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
        "-keyout", folder / "key.pem", "-out", request, "-subj", f"/O=foretrack tests/CN={name}")
    run("x509", "-req", "-in", request, "-CA", private / f"{identity_authority}.cert.pem", "-CAkey",
        private / f"{identity_authority}.key.pem", "-CAcreateserial", "-out", folder / "cert.pem",
        "-days", days)
    (folder / "key.pem").chmod(0o600)
    for target, source in (("identity_ca", identity_authority), ("permissions_ca", "permissions_ca")):
        (folder / f"{target}.cert.pem").write_bytes((private / f"{source}.cert.pem").read_bytes())
    signed(folder, "governance", GOVERNANCE, private, "permissions_ca")
    signed(folder, "permissions", permissions(name, writes), private, "permissions_ca")


def main():
    store = Path(sys.argv[1])
    for name in ("identity_ca", "permissions_ca", "other_ca"):
        authority(store / "private", name)
    itself = ["ros_discovery_info", "rt/*/health", "rt/diagnostics"]
    enclave(store, "vehicle", ["*"])
    enclave(store, "operator", ["*"])
    enclave(store, "viewer", itself)
    enclave(store, "stranger", ["*"], "other_ca")
    enclave(store, "expired", ["*"], days=-1)


if __name__ == "__main__":
    main()
