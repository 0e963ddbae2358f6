"""`twinform advise`: which format a robot is best kept in, and what each consumer makes of both.

`forms` converts the file into the other format, `choosing` has the reasons for each, `consumers` asks the profiles.
"""

from twinform.compiler.advice.advice_reporters import REPORTERS
from twinform.compiler.advice.advising import Advice, advise

__all__ = ["REPORTERS", "Advice", "advise"]
