// The page driven by look.js: shows one picture of the list after the other.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { placeHand } from './arms.js';
import { HANDS, PICTURES } from './poses.js';

const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.toneMapping = THREE.ACESFilmicToneMapping;
renderer.toneMappingExposure = 0.95;
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.PCFSoftShadowMap;
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x8a9299);
scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.04).texture;
scene.environmentIntensity = 0.45;
const key = new THREE.DirectionalLight(0xfff1e0, 2.2);
key.position.set(1.2, 2.6, 2.4);
key.castShadow = true;
key.shadow.mapSize.set(2048, 2048);
Object.assign(key.shadow.camera, { left: -0.9, right: 0.9, top: 0.9, bottom: -0.9, near: 0.5, far: 6 });
key.shadow.bias = -0.0004;
key.shadow.normalBias = 0.004;
key.target.position.set(0, 1.3, 0);
const fill = new THREE.DirectionalLight(0xdde8ff, 0.7);
fill.position.set(-2.2, 1.6, 1.8);
scene.add(key, key.target, fill);

const camera = new THREE.PerspectiveCamera(26, 1, 0.05, 20);
let bones, extras, meshes;

window.show = async (url) => {
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  const gltf = await loader.loadAsync(url);
  extras = gltf.asset.extras.signweave;
  bones = {};
  meshes = [];
  gltf.scene.traverse((node) => {
    if (node.isBone) bones[node.name] = node;
    if (node.isMesh) {
      node.frustumCulled = false;
      node.castShadow = node.receiveShadow = true;
      meshes.push(node);
    }
  });
  for (const child of [...scene.children]) if (child.isGroup) scene.remove(child);
  scene.add(gltf.scene);
};

/** Returns the camera of a view: [target, direction, height of the picture in metres]. */
function viewOf(name) {
  const [, eyeHeight, eyeDepth] = extras.eyes;
  const bust = new THREE.Vector3(0, eyeHeight - 0.22, 0.05);
  const face = new THREE.Vector3(0, eyeHeight - 0.045, eyeDepth - 0.06);
  if (name === 'side') return [bust, [1, 0, 0.05], 0.86];
  if (name === 'threeQuarter') return [bust, [0.7, 0.05, 1], 0.86];
  if (name === 'body') return [new THREE.Vector3(0, extras.height / 2, 0), [0.2, 0.03, 1], extras.height * 1.1];
  if (name === 'face') return [face, [0, 0, 1], 0.3];
  if (name === 'faceSide') return [face, [0.8, 0, 1], 0.3];
  if (name === 'hand') {
    const hand = new THREE.Vector3().setFromMatrixPosition(bones.finger3_1_R.matrixWorld);
    return [hand.add(new THREE.Vector3(0, 0.01, 0)), [0, 0, 1], 0.26];
  }
  return [bust, [0, 0.02, 1], 0.86];
}

window.draw = (name, width, height) => {
  const picture = PICTURES[name];
  for (const bone of Object.values(bones)) bone.quaternion.identity();
  for (const side of ['left', 'right']) if (picture[side]) placeHand(bones, extras, side, picture[side], HANDS);
  for (const mesh of meshes) {
    for (const [unit, index] of Object.entries(mesh.morphTargetDictionary ?? {})) mesh.morphTargetInfluences[index] = picture.face?.[unit] ?? 0;
  }
  scene.updateMatrixWorld(true);
  const [target, direction, tall] = viewOf(picture.view ?? 'front');
  const away = tall / 2 / Math.tan((camera.fov * Math.PI) / 360);
  camera.position.copy(target).add(new THREE.Vector3(...direction).normalize().multiplyScalar(away));
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
  renderer.setSize(width, height);
  renderer.render(scene, camera);
};
window.names = Object.keys(PICTURES);
window.viewName = (name) => PICTURES[name].view ?? 'front';
window.ready = true;
