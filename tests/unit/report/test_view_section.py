"""The frame of the view: nonces that names cannot know."""

from twinform.report.report_page import framed, policy

from .models import PAGE


def test_every_script_has_the_nonce_and_makes_others_with_it() -> None:
    made = framed(PAGE)
    assert made.page.count(f'<script nonce="{made.nonce}">') == made.page.count("<script") == 3
    assert made.page.index("createElement") < made.page.index("document.title")


def test_the_view_is_dark_where_the_page_is() -> None:
    config = framed(PAGE.replace("</head>", "<script>window.__VISER_EMBED_CONFIG__={darkMode:false};</script></head>"))
    head, _, _ = config.page.partition("</head>")
    assert head.index("darkMode:false") < head.index(".darkMode=matchMedia('(prefers-color-scheme: dark)').matches")


def test_the_nonce_depends_on_everything_in_the_page() -> None:
    assert framed(PAGE).nonce == framed(PAGE).nonce
    assert framed(PAGE).nonce != framed(PAGE.replace("view", "View")).nonce


def test_the_policy_without_a_view_allows_no_more_than_one_style_and_one_script() -> None:
    made = policy("a{}", "1", None)
    assert made.count("'sha256-") == 2
    assert "unsafe" not in made
