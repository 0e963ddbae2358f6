"""`AssetPass`: the base class of passes that read files beside a model."""

from typing import Self

from pydantic import PrivateAttr

from twinform.passes.framework.asset_access import NO_ASSETS, Assets
from twinform.passes.framework.pass_base import Pass


class AssetPass(Pass):
    """A pass that opens files which the document names.

    Files are not among its options: whoever runs it gives their places, by `with_assets`. Otherwise there are none.
    """

    _assets: Assets = PrivateAttr(default_factory=lambda: NO_ASSETS)  # one object, so that equal passes are equal

    def with_assets(self, assets: Assets) -> Self:
        """Return a copy of the pass that finds its files through these assets."""
        bound = self.model_copy()
        bound._assets = assets  # noqa: SLF001 - its own
        return bound
