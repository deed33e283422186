"""Studies in buckets, on a server of this machine. `cargo xtask s3` runs these tests with a build that supports buckets."""

import os
import shlex
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import _core, _store

built = pytest.mark.skipif(not _core.reaches_buckets, reason="built without the feature s3; `cargo xtask s3` builds one with it")


@pytest.fixture(scope="module")
def server() -> Iterator[str]:
    command = os.environ.get("VIBROIMPACT_S3_SERVER")
    if command is None:
        pytest.skip("there is no server that speaks S3; `cargo xtask s3` starts one")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    words = [word.replace("$PORT", str(port)) for word in shlex.split(command)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            begin = time.monotonic()
            while True:
                assert process.poll() is None and time.monotonic() < begin + 60, f"the server does not start: {command}"
                with socket.socket() as door:
                    if door.connect_ex(("127.0.0.1", port)) == 0:
                        break
                time.sleep(0.05)
            yield f"http://127.0.0.1:{port}"
        finally:
            process.kill()


@pytest.fixture
def bucket(server: str, monkeypatch: pytest.MonkeyPatch) -> str:
    settings = {"ENDPOINT_URL": server, "ALLOW_HTTP": "true", "REGION": "eu-central-1", "ACCESS_KEY_ID": "key", "SECRET_ACCESS_KEY": "secret"}
    for name in [name for name in os.environ if name.startswith("AWS_")]:
        monkeypatch.delenv(name)
    for name, value in settings.items():
        monkeypatch.setenv(f"AWS_{name}", value)
    key = "AWS4-HMAC-SHA256 Credential=key/20260101/us-east-1/s3/aws4_request, SignedHeaders=host, Signature=0"
    request = urllib.request.Request(f"{server}/studies", method="PUT", headers={"Authorization": key})
    with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(request) as answer:
        assert answer.status == 200
    return "s3://studies"


@built
@pytest.mark.filterwarnings("ignore")
def test_a_study_in_a_bucket_is_that_in_a_folder(bucket: str, s: vi.Oscillator, tmp_path: Path) -> None:
    over = {"inverse_beta": "1:1.5:7", "gap": "0:2:5"}
    plan = vi.Plan.map(s, over, starts=4, tile=3)
    place, folder = f"{bucket}/deep/map", tmp_path / "map.zarr"
    vi.run(plan, folder)
    assert vi.run(plan, place, part=(1, 2)) == vi.Ran(3, 0, 0, 3)
    far = vi.status(place)
    assert (far.tiles, far.done, far.complete, far.missing) == (6, 3, False, [1, 3, 5])
    assert vi.resume(place).computed == 3 and vi.verify(place, sample=6).whole
    assert vi.status(place).complete and vi.status(place).bytes == vi.status(folder).bytes
    ds = vi.region_map(s, over, starts=4, tile=3, store=place)
    want = vi.open(folder)
    assert ds.attrs == want.attrs and set(ds.variables) == set(want.variables)
    for name, of in want.variables.items():
        np.testing.assert_array_equal(ds[name].values, of.values, err_msg=str(name))
    assert ds.vibro.labels().values.tolist() == want.vibro.labels().values.tolist()
    # a sharded study, filled by two parts, has the same objects as a folder
    many = plan.with_tiles(tile=1, shard=3)
    vi.run(many, tmp_path / "many.zarr")
    for part in ((2, 2), (1, 2)):
        vi.run(many, f"{bucket}/many", part=part)
    assert vi.status(f"{bucket}/many").complete and vi.verify(f"{bucket}/many", sample=35).whole
    of_bucket, of_folder = vi.open(f"{bucket}/many").load(), vi.open(tmp_path / "many.zarr").load()
    assert of_bucket.identical(of_folder)
    words = [sys.executable, "-m", "vibroimpact", "export", place, "--format", "csv", tmp_path / "there.csv"]
    subprocess.run(words, check=True)
    words[4], words[-1] = folder, tmp_path / "here.csv"
    subprocess.run(words, check=True)
    assert (tmp_path / "there.csv").read_bytes() == (tmp_path / "here.csv").read_bytes()


@built
def test_a_bucket_that_cannot_be_used(bucket: str, s: vi.Oscillator, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = vi.Plan.basin(s, {"x": "-4:0.75:9"})
    with pytest.raises(vi.StoreError, match="there is no store at s3://studies/none"):
        vi.open(f"{bucket}/none")
    with pytest.raises(vi.StoreError, match="refuses: NoSuchBucket: .*\nhint: make the bucket first"):
        vi.run(plan, "s3://nobody/x")
    monkeypatch.setattr(_store, "find_spec", lambda name: None)
    # refused before the computation
    with pytest.raises(ImportError, match="needs s3fs, which is not installed\nhint: pip install s3fs"):
        vi.basin(s, x="-4:0.75:9", store=f"{bucket}/basin")
    with pytest.raises(vi.StoreError, match="there is no store"):
        vi.status(f"{bucket}/basin")


@pytest.mark.skipif(_core.reaches_buckets, reason="this build reaches buckets")
def test_a_build_without_buckets_says_how_to_get_one(s: vi.Oscillator) -> None:
    plan = vi.Plan.basin(s, {"x": "-4:0.75:9"})
    for call in (lambda: vi.run(plan, "s3://studies/x"), lambda: vi.status("s3://studies/x"), lambda: vi.open("s3://studies/x")):
        with pytest.raises(vi.StoreError, match=r'^s3://studies/x: this build of the package reaches folders only\nhint: `pip install \. --config-settings build-args="--features s3"`'):
            call()
