# Made by the build.
YADEFRAG: str
VERSION: str
SYSTEM: str
ACCEPTED: dict[str, str]
