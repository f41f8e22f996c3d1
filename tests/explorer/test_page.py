"""The served page: veil before script, kept copies, and what a client's page must look like for it."""

import urllib.error
import urllib.request
from collections.abc import Iterator

import pytest
import viser

from explorer.hosting import viser_compat
from explorer.hosting.limits import AllowedHosts
from explorer.hosting.request_filter import RequestFilter, with_loading_screen

CLIENT = (
    "<!doctype html><html><head><title>Viser</title>\n<script data-p=x>go()</script></head>\n"
    '<body>\n<div id="root"></div></body></html>'
)


def test_the_veil_comes_before_the_script_and_the_script_before_the_root():
    html = with_loading_screen(CLIENT).html.decode()
    parts = ("<title>Rotor explorer</title>", "</head>", 'id="rx-veil"', "data-p=x>go()", 'id="root"')
    assert [html.index(part) for part in parts] == sorted(html.index(part) for part in parts)
    assert html.count("<body>") == html.count("</head>") == 1


def test_the_client_is_built_as_expected():
    """What viser ships: when this fails, the pin may not move."""
    html = with_loading_screen(viser_compat.client_html()).html.decode()
    assert html.index('id="rx-veil"') < 10_000 < html.index('id="root"')


@pytest.mark.parametrize(
    "client", ["", "<html></html>", CLIENT.replace("<title>", "<t>"), CLIENT.replace("<body>", "")]
)
def test_another_page_is_refused(client: str):
    with pytest.raises(ValueError, match="not built as expected"):
        with_loading_screen(client)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    gate = RequestFilter(AllowedHosts("127.0.0.1"), 4, with_loading_screen(CLIENT))
    server: viser.ViserServer = viser_compat.quiet_server("127.0.0.1", 0, "x", gate)
    yield f"http://127.0.0.1:{server.get_port()}"
    viser_compat.quiet_stop(server)


def fetch(address: str, **headers: str) -> tuple[int, bytes, dict[str, str]]:
    request = urllib.request.Request(
        address, headers={name.replace("_", "-"): value for name, value in headers.items()}
    )
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, answer.read(), dict(answer.headers)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read(), dict(error.headers)


def test_a_browser_that_has_the_page_is_not_sent_it_again(address: str):
    status, body, headers = fetch(address + "/?d=1;linear:-8")
    assert (status, body) == (200, with_loading_screen(CLIENT).html)
    status, body, _ = fetch(address, If_None_Match=headers["ETag"])
    assert (status, body) == (304, b"")
    assert fetch(address, If_None_Match='"other"')[0] == 200


def test_the_page_is_packed_for_those_who_unpack(address: str):
    _, body, headers = fetch(address, Accept_Encoding="gzip, br")
    assert headers["Content-Encoding"] == "gzip"
    assert body == with_loading_screen(CLIENT).packed
