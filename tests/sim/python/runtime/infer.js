// node infer.js MODEL.onnx: reads rows of inputs, {name: {dims, data}}, as JSON; prints a row of actions for each.
const fs = require("fs");
const ort = require("onnxruntime-web");

ort.env.wasm.numThreads = 1;

async function main() {
  const session = await ort.InferenceSession.create(fs.readFileSync(process.argv[2]).buffer);
  const rows = JSON.parse(fs.readFileSync(0, "utf8"));
  const answers = [];
  for (const row of rows) {
    const feeds = {};
    for (const [name, { dims, data }] of Object.entries(row)) {
      feeds[name] = new ort.Tensor("float32", Float32Array.from(data), dims);
    }
    answers.push(Array.from((await session.run(feeds)).action.data));
  }
  console.log(JSON.stringify(answers));
}

main();
