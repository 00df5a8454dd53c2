# The extension: its functions check nothing that Python has checked.
from typing import Any

def __getattr__(name: str) -> Any: ...
