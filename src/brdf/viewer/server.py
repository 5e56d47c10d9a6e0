"""`brdf view`: the page on this machine, at an address that nobody else can guess, up to date with its files."""

from __future__ import annotations

import gzip
import os
import secrets
import sys
import threading
from collections.abc import Callable, Sequence
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, NamedTuple

from .. import __version__
from ..errors import BrdfError, ParameterError

HOST = "127.0.0.1"

POLL_SECONDS = 0.4
"""Between looks at the files."""

HEARTBEAT_SECONDS = 10.0
"""Between signs of life to an open page, by which the server notices that it is gone."""

PATIENCE_SECONDS = 30.0
"""For which a connection may say nothing."""

Stamp = tuple[tuple[str, int, int, int], ...]
"""Of a file, or of all in a folder: name, time, size, number."""


class Contents(NamedTuple):
    """What a page asks for. Data and picture may raise BrdfError: the document is served all the same, and says so."""

    document: str
    payload: Callable[[], bytes]
    picture: Callable[[], bytes]


class Server:
    """Serves one page until `stop`, on a thread of its own.

    `make` gives what is served; where a file of `watched`, or one in a folder of it, changes, it is asked anew, and
    open pages reload. `port`: 0 for any free one. Raises ParameterError for a port that is taken or none.
    """

    def __init__(self, make: Callable[[], Contents], watched: Sequence[Path] = (), port: int = 0) -> None:
        self._make, self._watched = make, tuple(watched)
        self._made: Contents | None = None
        self._seen = self._last = self._stamps()
        self._lock = threading.Lock()
        self._news = threading.Condition()
        self.version = 0
        self.stopped = False
        self.token = secrets.token_urlsafe(16)
        self._http = _listening(port, self)
        self._threads = [
            threading.Thread(target=self._http.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True),
            threading.Thread(target=self._watch, daemon=True),
        ]
        for thread in self._threads:
            thread.start()

    @property
    def port(self) -> int:
        return int(self._http.server_address[1])

    @property
    def address(self) -> str:
        return f"http://{HOST}:{self.port}/{self.token}/"

    @property
    def contents(self) -> Contents:
        """What is served now. Raises BrdfError where a changed file cannot be read."""
        with self._lock:
            if self._made is None:
                self._made = self._make()
            return self._made

    def wait(self) -> None:
        """Until `stop`, or Ctrl-C."""
        try:
            while not self.stopped:
                self._threads[0].join(1.0)
        finally:
            self.stop()

    def stop(self) -> None:
        """End it; open pages stay as they are."""
        if self.stopped:
            return
        self.stopped = True
        with self._news:
            self._news.notify_all()
        self._http.shutdown()
        self._http.server_close()

    def after(self, version: int) -> int:
        """The version once it is another, or the same when it is time for a sign of life."""
        with self._news:
            self._news.wait_for(lambda: self.stopped or self.version != version, HEARTBEAT_SECONDS)
            return self.version

    def _watch(self) -> None:
        while not self.stopped:
            with self._news:
                self._news.wait_for(lambda: self.stopped, POLL_SECONDS)
            if self._changed():
                with self._lock:
                    self._made = None
                with self._news:
                    self.version += 1
                    self._news.notify_all()

    def _changed(self) -> bool:
        """Whether a file is another than at the last look. One that is being replaced is there again soon: that it is
        gone counts when it is seen twice."""
        now, last, seen = self._stamps(), self._last, self._seen
        self._last = now
        self._seen = [old if new is None and before else new for new, before, old in zip(now, last, seen, strict=True)]
        return self._seen != seen

    def _stamps(self) -> list[Stamp | None]:
        return [_stamp(path) for path in self._watched]


def _stamp(path: Path) -> Stamp | None:
    try:
        files = sorted(path.iterdir()) if path.is_dir() else [path]
        found = [(file.name, file.stat()) for file in files]
    except OSError:
        return None
    return tuple((name, status.st_mtime_ns, status.st_size, status.st_ino) for name, status in found)


class _HTTPServer(ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = os.name == "posix"
    owner: Server

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Print what went wrong, unless the other side hung up, as browsers do at any time: that is no mistake."""
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)


def _listening(port: int, owner: Server) -> _HTTPServer:
    if not 0 <= port <= 65535:
        raise ParameterError(f"a port lies between 1 and 65535, or is 0 for any free one; got {port}")
    try:
        server = _HTTPServer((HOST, port), _Handler)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise ParameterError(f"port {port} cannot be used ({reason}); choose another, or none for a free one") from None
    server.owner = owner
    return server


class _Handler(BaseHTTPRequestHandler):
    """Answers GET and HEAD of four paths below the token, for the name under which this machine calls itself."""

    server: _HTTPServer
    server_version = f"brdf/{__version__}"
    sys_version = ""
    protocol_version = "HTTP/1.1"
    timeout = PATIENCE_SECONDS

    def do_GET(self) -> None:
        owner = self.server.owner
        # A page of another site whose name was turned to this machine still says its own name: DNS rebinding.
        if self.headers.get("Host") not in (f"{HOST}:{owner.port}", f"localhost:{owner.port}"):
            self._answer(HTTPStatus.FORBIDDEN, "text/plain", b"Open the address that brdf view prints.\n")
            return
        token, slash, name = self.path.partition("?")[0].removeprefix("/").partition("/")
        if not slash or not secrets.compare_digest(token.encode(), owner.token.encode()) or name not in PATHS:
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"There is nothing here.\n")
            return
        try:
            PATHS[name](self)
        except BrdfError as error:
            self._answer(HTTPStatus.CONFLICT, "text/plain; charset=utf-8", str(error).encode())

    do_HEAD = do_GET  # noqa: N815  (so the library calls it)

    def do_POST(self) -> None:
        self.close_connection = True  # what follows, however long, is not read
        self._answer(HTTPStatus.METHOD_NOT_ALLOWED, "text/plain", b"Pages are only read here.\n")

    do_PUT = do_DELETE = do_PATCH = do_OPTIONS = do_POST  # noqa: N815

    def _document(self) -> None:
        self._answer(HTTPStatus.OK, "text/html; charset=utf-8", self.server.owner.contents.document.encode())

    def _payload(self) -> None:
        self._answer(HTTPStatus.OK, "application/octet-stream", self.server.owner.contents.payload(), compress=True)

    def _picture(self) -> None:
        self._answer(HTTPStatus.OK, "image/webp", self.server.owner.contents.picture())

    def _events(self) -> None:
        """Server-sent events: the version, at first and whenever there is another. A page that connects late, or anew,
        so learns what it missed."""
        owner = self.server.owner
        self.close_connection = True
        self._head(HTTPStatus.OK, "text/event-stream")
        self.end_headers()
        version = -1
        while not owner.stopped and self.command == "GET":
            known, version = version, owner.after(version)
            self.wfile.write(f"data: {version}\n\n".encode() if version != known else b": here\n\n")
            self.wfile.flush()

    def _answer(self, status: HTTPStatus, kind: str, body: bytes, compress: bool = False) -> None:
        if compress and "gzip" in self.headers.get("Accept-Encoding", ""):
            body = gzip.compress(body, 1)
        else:
            compress = False
        self._head(status, kind)
        if compress:
            self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def _head(self, status: HTTPStatus, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Cross-Origin-Resource-Policy", "same-origin")
        self.send_header("Referrer-Policy", "no-referrer")
        self.send_header("X-Frame-Options", "DENY")
        if status is HTTPStatus.METHOD_NOT_ALLOWED:
            self.send_header("Allow", "GET, HEAD")
        if self.close_connection:
            self.send_header("Connection", "close")

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """What the library answers to other methods and to what is no HTTP, without reading what may follow."""
        self.close_connection = True
        super().send_error(code, message, explain)

    def log_message(self, format: str, *arguments: object) -> None:
        return None


PATHS: dict[str, Callable[[_Handler], None]] = {
    "": _Handler._document,
    "payload": _Handler._payload,
    "picture": _Handler._picture,
    "events": _Handler._events,
}
