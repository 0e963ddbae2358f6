"""Why a view cannot be shown."""


class ViewError(Exception):
    """A view cannot be shown."""


class ViewerMissingError(ViewError):
    """A library that draws the view is not installed."""

    def __init__(self, library: str) -> None:
        super().__init__(f"the 3D view needs {library}: run pip install 'twinform[view]'")


class PortTakenError(ViewError):
    """Another program listens at the port."""

    def __init__(self, port: int) -> None:
        super().__init__(f"port {port} of this machine is taken: choose another one, or leave --port out")
