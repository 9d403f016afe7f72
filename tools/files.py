"""Files written so that a kill at any moment leaves the old one or the new one, never half of one."""


def write(path, content):
    """Text or bytes; makes folders. What a kill leaves beside is overwritten by the next write."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(path.name + ".part")
    data = content.encode() if isinstance(content, str) else content
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def requireWritable(path):
    """Raises the OSError that writing it would, and leaves nothing behind but its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(path.name + ".part")
    temporary.touch()
    temporary.unlink()
