"""Start the explorer as a service would, visit it, stop it; `tests/test_deploy.py` runs this on a read-only system."""

import asyncio
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
sys.path.insert(0, str(ROOT))

from tests.tools.soak.visitor import Visitor  # noqa: E402 - run as a script, outside the test runner's path


async def visit(address: str) -> str:
    """The power that the page shows."""
    async with asyncio.timeout(120.0):
        visitor = Visitor()
        await visitor.open(address)
        await visitor.until(lambda: visitor.text("status") == "converged", 120.0)
        power = visitor.text("total-power")
        await visitor.close()
        return power


def facts(port: int) -> dict[str, object]:
    """What was seen."""
    command = [sys.executable, "-m", "explorer", "--no-browser", "--port", str(port)]
    server = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert server.stdout is not None
    printed = server.stdout.readline()
    power = asyncio.run(visit(f"http://127.0.0.1:{port}")) if "http://" in printed else ""
    server.send_signal(signal.SIGTERM)
    _, errors = server.communicate(timeout=90)
    writable = [place for place in (ROOT, Path("/"), Path("/usr")) if os.access(place, os.W_OK)]
    seen = {"power": power, "code": server.returncode, "errors": errors, "home": os.environ.get("HOME")}
    return {**seen, "writable": [str(place) for place in writable]}


if __name__ == "__main__":
    print(json.dumps(facts(int(sys.argv[1]))))
