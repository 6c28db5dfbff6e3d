"""`OneAtATime`: no two callbacks of a group run together."""

from tendon_statics.node.one_at_a_time import OneAtATime


def test_only_who_began_first_may_run_until_it_ends():
    group = OneAtATime()
    assert group.can_execute('one')
    assert group.beginning_execution('one')
    assert not group.can_execute('other')
    assert not group.beginning_execution('other')
    group.ending_execution('one')
    assert group.can_execute('other')
    assert group.beginning_execution('other')
