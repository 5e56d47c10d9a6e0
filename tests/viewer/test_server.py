"""The server of `brdf view`: what it serves, to whom, and what it refuses."""

from __future__ import annotations

import gzip
import http.client
import socket
import struct
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from brdf.errors import CorruptFileError, ParameterError
from brdf.viewer.server import HOST, Contents, Server

LIMIT = 20.0
"""Seconds after which something that should happen did not."""


@pytest.fixture
def watched(tmp_path: Path) -> Path:
    path = tmp_path / "material.txt"
    path.write_text("first", "utf-8")
    return path


@pytest.fixture
def server(watched: Path) -> Iterator[Server]:
    def make() -> Contents:
        text = watched.read_text("utf-8")
        if text == "broken":
            raise CorruptFileError(watched, "ends too early.")
        return Contents(f"<p>{text}", lambda: text.encode() * 1000, lambda: b"picture")

    running = Server(make, [watched])
    yield running
    running.stop()


def ask(
    server: Server, path: str | None = None, method: str = "GET", **headers: str
) -> tuple[int, bytes, dict[str, str]]:
    """Status, body and headers of the answer."""
    connection = http.client.HTTPConnection(HOST, server.port, timeout=LIMIT)
    place = path if path is not None else f"/{server.token}/"
    connection.request(method, place, headers={name.replace("_", "-"): value for name, value in headers.items()})
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, body, {name.lower(): value for name, value in answer.getheaders()}


def test_the_page_its_data_and_its_picture(server: Server) -> None:
    assert server.address == f"http://127.0.0.1:{server.port}/{server.token}/"
    status, body, headers = ask(server)
    assert (status, body, headers["content-type"]) == (200, b"<p>first", "text/html; charset=utf-8")
    assert headers["cache-control"] == "no-store"
    status, body, headers = ask(server, f"/{server.token}/payload", Accept_Encoding="gzip")
    assert headers["content-encoding"] == "gzip"
    assert gzip.decompress(body) == b"first" * 1000
    assert ask(server, f"/{server.token}/payload")[1] == b"first" * 1000
    assert ask(server, f"/{server.token}/picture?again")[1] == b"picture"


def test_head_gives_no_body(server: Server) -> None:
    status, body, headers = ask(server, method="HEAD")
    assert (status, body, headers["content-length"]) == (200, b"", "8")


@pytest.mark.parametrize("path", ["/", "/payload", "/TOKEN", "/token/", "/TOKEN/../../pyproject.toml", "/TOKEN//", "*"])
def test_nothing_else_is_there(server: Server, path: str) -> None:
    assert ask(server, path.replace("TOKEN", server.token))[0] == 404


def test_two_servers_have_different_tokens(server: Server) -> None:
    other = Server(lambda: Contents("", bytes, bytes))
    assert other.token != server.token
    assert len(other.token) >= 20
    other.stop()


@pytest.mark.parametrize("host", ["evil.example", "evil.example:PORT", "127.0.0.1", "127.0.0.1:1", ""])
def test_other_names_for_this_machine_are_refused(server: Server, host: str) -> None:
    status, body, _ = ask(server, Host=host.replace("PORT", str(server.port)))
    assert status == 403
    assert b"first" not in body
    assert ask(server, Host=f"localhost:{server.port}")[0] == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS"])
def test_nothing_can_be_sent(server: Server, method: str) -> None:
    status, _, headers = ask(server, method=method)
    assert status == 405
    assert headers["allow"] == "GET, HEAD"


def test_an_upload_is_refused_before_it_is_read(server: Server) -> None:
    with socket.create_connection((HOST, server.port), LIMIT) as connection:
        request = f"POST /{server.token}/ HTTP/1.1\r\nHost: {HOST}:{server.port}\r\nContent-Length: 2147483648\r\n\r\n"
        connection.sendall(request.encode())
        assert connection.recv(100).startswith(b"HTTP/1.1 405 ")
        while connection.recv(1000):  # the server hangs up, although it was sent nothing of all that
            pass


@pytest.mark.parametrize("path", ["TOKEN/", "TOKEN/payload", "TOKEN/events", "elsewhere"])
@pytest.mark.parametrize("most", [1, 10000])
def test_a_connection_that_is_reset_prints_nothing(
    path: str, most: int, server: Server, capsys: pytest.CaptureFixture[str]
) -> None:
    connection = http.client.HTTPConnection(HOST, server.port, timeout=LIMIT)
    connection.request("GET", "/" + path.replace("TOKEN", server.token))
    connection.sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # closing it resets
    answer = connection.getresponse()
    answer.read1(most)
    answer.close()
    connection.close()
    if path.endswith("events"):
        server.stop()  # of a page that is gone, the stream would learn at its next sign of life
    until(lambda: not answering())
    assert capsys.readouterr().err == ""


def answering() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if "process_request_thread" in thread.name]


def test_mistakes_of_ours_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    def fails() -> bytes:
        raise ZeroDivisionError("in the picture")

    running = Server(lambda: Contents("", bytes, fails))
    try:
        with pytest.raises(http.client.RemoteDisconnected):
            ask(running, f"/{running.token}/picture")
        until(lambda: not answering())
        assert "ZeroDivisionError: in the picture" in capsys.readouterr().err
    finally:
        running.stop()


def test_it_listens_to_this_machine_alone(server: Server) -> None:
    assert server._http.server_address[0] == "127.0.0.1"


def test_a_changed_file_is_served_anew_and_told_to_open_pages(server: Server, watched: Path) -> None:
    ask(server)
    connection = http.client.HTTPConnection(HOST, server.port, timeout=LIMIT)
    connection.request("GET", f"/{server.token}/events")
    events = connection.getresponse()
    assert events.getheader("Content-Type") == "text/event-stream"
    assert told(events) == 0  # a page that connects late learns what there is
    watched.write_text("second", "utf-8")
    assert told(events) == 1
    assert ask(server)[1] == b"<p>second"
    watched.write_text("broken", "utf-8")
    until(lambda: server.version == 2)
    status, body, _ = ask(server)
    assert (status, body.decode()) == (409, f"{watched}: ends too early.")
    watched.unlink()
    watched.write_text("the third", "utf-8")
    until(lambda: ask(server)[1] == b"<p>the third")
    connection.close()


def told(events: http.client.HTTPResponse) -> int:
    """The next version of which a stream tells."""
    while not (line := events.readline()).startswith(b"data: "):
        assert line
    return int(line.removeprefix(b"data: "))


def test_of_two_files_one_may_be_missing(server: Server, watched: Path) -> None:
    other = watched.with_name("other.txt")
    other.write_text("other", "utf-8")
    running = Server(lambda: Contents("", bytes, bytes), [watched, other])
    try:
        other.unlink()
        until(lambda: running.version == 1)
        watched.write_text("second", "utf-8")
        until(lambda: running.version == 2)
        other.write_text("again", "utf-8")
        until(lambda: running.version == 3)
    finally:
        running.stop()


def test_a_file_that_is_replaced_is_no_missing_one(server: Server, watched: Path) -> None:
    looks = iter([b"first", None, b"second", b"second", None, None, None])
    server.stop()
    server._seen = server._last = [b"first"]  # type: ignore[list-item]
    server._stamps = lambda: [next(looks)]  # type: ignore[method-assign, list-item]
    assert [server._changed() for _ in range(7)] == [False, False, True, False, False, True, False]


def test_the_files_of_a_folder_are_watched(tmp_path: Path) -> None:
    (tmp_path / "picture.png").write_bytes(b"1")
    running = Server(lambda: Contents("", bytes, bytes), [tmp_path])
    try:
        (tmp_path / "picture.png").write_bytes(b"22")
        until(lambda: running.version == 1)
    finally:
        running.stop()


def until(holds: object) -> None:
    assert callable(holds)
    end = time.monotonic() + LIMIT
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_stopping_ends_the_threads_and_open_streams(server: Server) -> None:
    connection = http.client.HTTPConnection(HOST, server.port, timeout=LIMIT)
    connection.request("GET", f"/{server.token}/events")
    events = connection.getresponse()
    waiting = threading.Thread(target=server.wait)
    waiting.start()
    server.stop()
    waiting.join(LIMIT)
    assert not waiting.is_alive()
    assert b"data: 1" not in events.read()
    with pytest.raises(OSError):
        socket.create_connection((HOST, server.port), 1.0)


def test_a_port_in_use_and_ports_that_are_none(server: Server) -> None:
    with pytest.raises(ParameterError, match=rf"port {server.port} cannot be used \(Address already in use\); choose"):
        Server(lambda: Contents("", bytes, bytes), port=server.port)
    with pytest.raises(ParameterError, match="a port lies between 1 and 65535, or is 0 for any free one; got 70000"):
        Server(lambda: Contents("", bytes, bytes), port=70000)
