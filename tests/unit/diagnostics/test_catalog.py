import re

from generators.rules_page import rules_page
from twinform.diagnostics import catalog
from twinform.diagnostics.diagnostic import GROUPS
from twinform.diagnostics.rule_page import sections, severity_words

RULES = list(catalog().values())


def test_every_text_of_a_rule_is_written() -> None:
    for rule in RULES:
        for text in (rule.finds, rule.matters, rule.example, rule.better):
            assert text.strip() == text
            assert text
        assert all(text for _, text in sections(rule))
        assert rule.finds.rstrip("`").endswith((".", ")", ":")), rule.name


def test_names_are_kebab_case_and_no_instructions() -> None:
    for rule in RULES:
        assert re.fullmatch(r"[a-z]+(-[a-z0-9]+)*", rule.name)
        assert not rule.name.startswith(("check-", "do-", "use-")), rule.name


def test_strict_is_never_milder() -> None:
    for rule in RULES:
        assert rule.severity_in(strict=True) >= rule.severity_in(strict=False), rule.name
        assert str(rule.severity) in severity_words(rule)


def test_rules_are_sorted_and_unique() -> None:
    assert list(catalog()) == sorted({rule.name for rule in RULES})


def test_the_page_has_every_rule_once_in_order_in_its_group() -> None:
    groups = dict(re.findall(r"^## (\w+)\n(.*?)(?=^##|\Z)", rules_page(), re.MULTILINE | re.DOTALL))
    assert list(groups) == list(GROUPS)
    for group, table in groups.items():
        wanted = [name for name, rule in catalog().items() if rule.group == group]
        assert re.findall(r"^\| \[(.*?)\]", table, re.MULTILINE) == wanted
