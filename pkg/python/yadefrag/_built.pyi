# Made by the build.
YADEFRAG: str
VERSION: str
BUILD: str
BUILD_ID: str
FEATURES: list[str] | None
COMMAND: str
ACCEPTED: dict[str, str]
