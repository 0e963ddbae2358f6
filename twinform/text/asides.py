"""Comments, CDATA sections and instructions of XML, as parts of regular expressions.

One that never ends goes to the end of the text, as an XML parser has it. If it were no match instead, a text of nothing
but beginnings would be searched for an end from each of them.
"""

# Possessive repetitions (Python 3.11): they never give back what they took, so no text makes them
# quadratic.
IN_COMMENT = r"[^-]*+(?:-(?!->)[^-]*+)*+"
IN_SECTION = r"[^\]]*+(?:\](?!\]>)[^\]]*+)*+"
IN_INSTRUCTION = r"[^?]*+(?:\?(?!>)[^?]*+)*+"

COMMENT = rf"<!--{IN_COMMENT}(?:-->)?"
SECTION = rf"<!\[CDATA\[{IN_SECTION}(?:\]\]>)?"
INSTRUCTION = rf"<\?{IN_INSTRUCTION}(?:\?>)?"
