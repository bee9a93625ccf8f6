// As much of the engine's types as the behaviour uses, so that a compiler can read it.
using System.Reflection;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }
    public class Transform { public Vector3 position; }
    public class MonoBehaviour
    {
        public Transform transform = new Transform();

        bool isOn;
        /// As in the engine: switching is told to the behaviour's own method, whether it is private or not.
        public bool enabled
        {
            get { return isOn; }
            set
            {
                if (isOn == value) return;
                isOn = value;
                const BindingFlags Own = BindingFlags.Instance | BindingFlags.NonPublic;
                GetType().GetMethod(value ? "OnEnable" : "OnDisable", Own).Invoke(this, null);
            }
        }
    }
    public static class Debug { public static void LogWarning(object text) { System.Console.Error.WriteLine(text); } }
}
