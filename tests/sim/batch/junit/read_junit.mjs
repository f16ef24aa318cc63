// Prints a JUnit file as JSON, read by junit2json: node read_junit.mjs FILE
import {readFileSync} from 'node:fs';
import {parse} from 'junit2json';

console.log(JSON.stringify(await parse(readFileSync(process.argv[2], 'utf8'))));
