"""The page that is served: viser's client with a loading screen until there is something to see.

Without it a visitor looks at an empty window while 800 kB of script unpack, and then at panels and a picture that move
into place one after the other. The loading screen is the first element of the page. It goes when the page has a
solution and its layout is at rest, and comes back when the server returns after a break.
"""

import gzip
import hashlib
from dataclasses import dataclass
from functools import cached_property

from explorer import web

TITLE = "Rotor explorer"
_SCRIPT_BEGINS, _HEAD_ENDS, _BODY_BEGINS = "<script", "</head>", "<body>"


@dataclass(frozen=True)
class ServedPage:
    """The served page."""

    html: bytes

    @cached_property
    def packed(self) -> bytes:
        """Compressed by gzip."""
        return gzip.compress(self.html, 6, mtime=0)

    @cached_property
    def tag(self) -> str:
        """ETag: a browser that holds this version need not fetch it again."""
        return f'"{hashlib.sha256(self.html).hexdigest()[:16]}"'


def with_loading_screen(client: str, frame: str = "") -> ServedPage:
    """The client's page with our title, the loading screen, and the `frame` behind it; ValueError for another layout.

    Its script moves from the head behind the loading screen, which is then painted while the script arrives.
    """
    head, begins, rest = client.partition(_SCRIPT_BEGINS)
    script, ends, tail = rest.partition(_HEAD_ENDS)
    before, body, content = tail.partition(_BODY_BEGINS)
    if not (begins and ends and body) or before.strip() or "<title>" not in head:
        raise ValueError("The client's page is not built as expected: a head that ends in its script, then a body.")
    title, _, after = head.partition("<title>")
    head = f"{title}<title>{TITLE}{after[after.index('</title>') :]}"
    veil = web.text("loading.html") + web.scripts("loading.js")
    return ServedPage(f"{head}{web.styles('loading.css')}{ends}{body}{veil}{frame}{begins}{script}{content}".encode())
