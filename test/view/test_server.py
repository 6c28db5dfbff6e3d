"""The program ``view``: where it serves the page, to whom, and how it refuses to start."""

import base64
import os
import socket
import sys
from contextlib import closing
from http.client import HTTPConnection
from urllib.error import URLError
from urllib.request import urlopen

import pytest
from forked_programs import ForkedProgram
from live_page import view_url
from make_docs import ROOT
from ros_domain import free_domain, in_domain
from ros_programs import Program, wait_for


@pytest.fixture(scope='module', autouse=True)
def domain():
    with free_domain() as domain, in_domain(domain):
        yield


def view(*parameters, kind=ForkedProgram):
    arguments = [part for parameter in parameters for part in ('-p', parameter)]
    return kind.running('view', '--ros-args', *arguments)


@pytest.fixture(scope='module')
def url():
    with view('port:=0') as program:
        yield view_url(program)


def answer_to_websocket(url, origin):
    """The code with which a server answers a page of another origin that wants to listen."""
    server = HTTPConnection(url.removeprefix('http://'))
    headers = {
        'Connection': 'Upgrade',
        'Upgrade': 'websocket',
        'Sec-WebSocket-Version': '13',
        'Sec-WebSocket-Key': base64.b64encode(os.urandom(16)).decode(),
        'Origin': origin,
    }
    with closing(server):
        server.request('GET', '/ws', headers=headers)
        return server.getresponse().status


REFUSED = 403


def test_other_web_pages_of_a_browser_cannot_listen(url):
    assert answer_to_websocket(url, 'http://elsewhere.example') == REFUSED
    port = url.rpartition(':')[2]
    assert answer_to_websocket(url, f'http://elsewhere.example:{port}') == REFUSED


@pytest.mark.parametrize('origin', ['http://localhost:9000', 'http://127.0.0.1:8780'])
def test_the_page_may_be_forwarded_to_any_port(url, origin):
    # Without a token the listening itself is refused, in other words.
    assert answer_to_websocket(url, origin) != REFUSED


def test_by_default_nobody_else_can_reach_it(url):
    host, port = url.removeprefix('http://').split(':')
    assert host == '127.0.0.1'
    with socket.socket() as other, pytest.raises(ConnectionRefusedError):
        other.connect(('127.0.0.2', int(port)))


def test_another_address_is_a_warning_and_has_its_own_names():
    with view('port:=0', 'address:=127.0.0.3', 'host:=robot.example') as program:
        url = view_url(program)
        assert url.startswith('http://127.0.0.3:')
        assert 'Anyone who can reach 127.0.0.3 can see the page' in program.output()
        port = url.rpartition(':')[2]
        for name in ('127.0.0.3', 'robot.example', socket.gethostname()):
            assert answer_to_websocket(url, f'http://{name}:{port}') != REFUSED
        assert answer_to_websocket(url, f'http://elsewhere.example:{port}') == REFUSED


def test_no_address_but_its_own_is_no_warning():
    with view('port:=0') as program:
        view_url(program)
        assert 'Anyone' not in program.output()


def assert_refused(program, *named):
    assert program.wait() == 1
    (line,) = [line for line in program.output().splitlines() if 'cannot start' in line]
    assert line.startswith('view cannot start: ')
    for text in named:
        assert text in line
    assert 'Traceback' not in program.output()


def test_a_port_that_is_taken_is_said_in_a_line_with_a_way_out(url):
    port = url.rpartition(':')[2]
    with view(f'port:={port}') as program:
        assert_refused(program, port, 'in use', '-p port:=')


@pytest.mark.parametrize('address', ['robot.invalid', '192.0.2.1', 'no address'])
def test_an_address_that_is_not_of_this_machine_is_said_in_a_line(address):
    with view('port:=0', f'address:="{address}"') as program:
        assert_refused(program, address)


@pytest.mark.parametrize('parameter', ['port:=70000', 'rate:=30.0', 'rate:=0.0'])
def test_a_parameter_out_of_range_is_said_in_a_line(parameter):
    with view(parameter) as program:
        assert_refused(program, parameter.partition(':')[0], 'allowed is')


def test_a_missing_library_is_said_in_a_line_with_the_remedy(tmp_path, monkeypatch):
    stand_in = "raise ModuleNotFoundError(\"No module named 'bokeh'\", name='bokeh')"
    (tmp_path / 'bokeh.py').write_text(stand_in)
    monkeypatch.setenv('PYTHONPATH', f'{tmp_path}:{os.environ["PYTHONPATH"]}')
    with view('port:=0', kind=Program) as program:
        assert_refused(program, 'Bokeh', "pip install '.[view]'")


def test_missing_interfaces_are_said_in_a_line(tmp_path, monkeypatch):
    stand_in = "raise ImportError('no interfaces here')"
    (tmp_path / 'tendon_statics_interfaces.py').write_text(stand_in)
    monkeypatch.setenv('PYTHONPATH', f'{tmp_path}:{os.environ["PYTHONPATH"]}')
    with view('port:=0', kind=Program) as program:
        assert_refused(program, 'no interfaces here', 'interfaces/')


@pytest.mark.parametrize('of', [(), ('--arm',)])
def test_the_demo_shows_a_page_until_it_is_ended_and_leaves_nothing(of):
    with Program.running_command(
        [sys.executable, ROOT / 'tools/demo_view.py', '--port', '0', *of]
    ) as demo:
        wait_for(
            'the page', lambda: 'Live page: ' in demo.output() or demo.process.poll() is not None
        )
        url = demo.output().split('Live page: ')[1].split()[0]
        with urlopen(url) as page:
            assert '<title>tendon_statics</title>' in page.read().decode()
        assert demo.end() == 0, demo.output()
        with pytest.raises(URLError):
            urlopen(url)
