"""The job of writing an image as PNG; it is decoded in the process of mesh files, which is confined."""

import io

from PIL import Image

from twinform.passes.mesh_jobs.job import MeshJob, MeshResult


def image(job: MeshJob) -> MeshResult:
    """Write the first picture of an image file as PNG, with its transparency if it has any."""
    made = io.BytesIO()
    with Image.open(io.BytesIO(job.content)) as picture:
        is_clear = picture.mode in {"RGBA", "LA", "PA"} or "transparency" in picture.info
        picture.convert("RGBA" if is_clear else "RGB").save(made, "PNG")
    return MeshResult({}, {".png": made.getvalue()})
