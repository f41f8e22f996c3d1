"""Host names and origins that the server accepts."""

import pytest

from explorer.hosting.limits import AllowedHosts, host_name, is_loopback, warning


@pytest.mark.parametrize("host", ["127.0.0.1:8080", "localhost:8080", "LOCALHOST", "[::1]:8080", "localhost."])
def test_this_machine_is_reached_by_its_own_names(host: str):
    assert AllowedHosts("127.0.0.1").refusal(host, None) is None


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8080", "127.0.0.1.evil.example", "192.168.1.5", "", None]
)
def test_a_foreign_name_for_this_machine_is_refused(host: str | None):
    """DNS rebinding: the attacker's own name, with our address."""
    assert "does not answer" in (AllowedHosts("127.0.0.1").refusal(host, None) or "")


@pytest.mark.parametrize("host", ["evil.example/@127.0.0.1", "a@127.0.0.1", "127.0.0.1:x", "[::1", "127.0.0.1?x"])
def test_an_invalid_host_is_refused(host: str):
    assert AllowedHosts("127.0.0.1").refusal(host, None)


def test_a_further_name_may_be_allowed():
    hosts = AllowedHosts("127.0.0.1", ("rotor.example",))
    assert hosts.refusal("rotor.example", "https://rotor.example") is None
    assert hosts.refusal("rotor.example:443", "https://rotor.example") is None
    assert hosts.refusal("rotor.example.evil.example", None)


def test_a_proxy_may_put_its_own_host():
    hosts = AllowedHosts("127.0.0.1", ("rotor.example",))
    assert hosts.refusal("127.0.0.1:8080", "https://rotor.example") is None
    assert hosts.refusal("127.0.0.1:8080", "https://evil.example")


def test_other_machines_connect_by_number_or_by_this_machines_name():
    hosts = AllowedHosts("0.0.0.0")
    assert hosts.refusal("192.168.1.5:8080", "http://192.168.1.5:8080") is None
    assert hosts.refusal("[fe80::1]:8080", None) is None
    assert hosts.refusal("evil.example:8080", None)


@pytest.mark.parametrize("origin", ["http://127.0.0.1:8080", "HTTP://127.0.0.1:8080".lower()])
def test_own_pages_may_connect(origin: str):
    assert AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", origin) is None


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "https://127.0.0.1.evil.example:8080",
        "http://127.0.0.1:9999",  # Another server of this machine.
        "http://localhost:8080",  # Another origin to the browser, too.
        "https://127.0.0.1",
        "null",
        "file://",
        "",
        "chrome-extension://abcdef",
    ],
)
def test_foreign_pages_may_not_connect(origin: str):
    assert "may not use" in (AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", origin) or "")


def test_a_client_without_origin_is_accepted():
    assert AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", None) is None


def test_an_invalid_name_cannot_be_allowed():
    assert host_name("Rotor.example:8080") == "rotor.example"
    for wrong in ("https://rotor.example", "rotor.example/page", "", "a@b"):
        with pytest.raises(ValueError, match="is not a host name"):
            host_name(wrong)


def test_loopback_addresses_are_known():
    assert all(map(is_loopback, ("127.0.0.1", "127.1.2.3", "::1", "localhost")))
    assert not any(map(is_loopback, ("0.0.0.0", "::", "192.168.1.5", "rotor.example", "")))


def test_the_warning_has_two_lines_and_the_remedy():
    assert warning("0.0.0.0").count("\n") == 1
    assert "--allow-host" in warning("0.0.0.0")
    assert "docs/deploy.md" in warning("0.0.0.0")
