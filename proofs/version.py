"""The version, as the package and the commands tell it."""

VERSION = "1.0.0"
