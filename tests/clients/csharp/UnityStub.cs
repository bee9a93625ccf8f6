// As much of the engine's types as the behaviour uses, so that a compiler can read it.
namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }
    public class Transform { public Vector3 position; }
    public class MonoBehaviour { public Transform transform = new Transform(); }
    public static class Debug { public static void LogWarning(object text) { System.Console.Error.WriteLine(text); } }
}
