from glob import glob

from setuptools import find_packages, setup

package_name = 'tendon_statics'
share = f'share/{package_name}'

setup(
    name=package_name,
    version='0.2.0',
    packages=find_packages(include=[package_name, f'{package_name}.*']),
    package_data={package_name: ['py.typed', 'view/page.html']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (share, ['package.xml']),
        (f'{share}/config', glob('config/*')),
        (f'{share}/launch', glob('launch/*.launch.py')),
        (f'{share}/layouts', glob('layouts/*')),
        (f'{share}/rviz', glob('rviz/*.rviz')),
        (f'{share}/security', glob('security/*')),
        (f'{share}/urdf', glob('urdf/*.xacro')),
        (f'{share}/hook', ['resource/path.dsv']),
    ],
    install_requires=['setuptools', 'PyYAML', 'numpy>=1.26.4'],
    extras_require={
        'calibration': ['scipy>=1.11.4'],
        'recordings': [
            'lz4>=4',
            'mcap>=1.2.1',
            'pyarrow>=15',
            'rosbags>=0.10.8',
            'tqdm>=4.64',
            'zstandard>=0.22',
        ],
        'archive': ['distributed>=2024.1', 'pyarrow>=15', 'tqdm>=4.64'],
        'matlab': ['pymatreader>=1.0'],
        'plot': ['matplotlib'],
        'view': ['bokeh>=3.4'],
        'test': ['hypothesis', 'mpmath', 'playwright', 'pytest', 'scipy>=1.11.4', 'xacro'],
    },
    zip_safe=False,
    maintainer='tendon_statics maintainers',
    maintainer_email='maintainers@users.noreply.h-seed-45baf2cd.example',
    description='Bend angle and joint pressure of tendon-driven units from cable tensions.',
    license='Apache-2.0',
    python_requires='>=3.10',
    entry_points={
        'console_scripts': [
            'arm_estimator = tendon_statics.node.program:arm_estimator',
            'estimator = tendon_statics.node.program:estimator',
            'pulley_driver = tendon_statics.driver.program:pulley_driver',
            'view = tendon_statics.view.program:view',
            'tendon-statics = tendon_statics.command_line.main:main',
        ],
    },
)
