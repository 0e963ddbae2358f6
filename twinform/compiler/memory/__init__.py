"""What a source said and its way back alone would not find again travels along, so that home is where one came from."""

from twinform.compiler.memory.document import Memory, take_memory
from twinform.compiler.memory.way_back import is_unedited, recall, recall_whole, remember

__all__ = ["Memory", "is_unedited", "recall", "recall_whole", "remember", "take_memory"]
